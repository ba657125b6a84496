/// What stands in the way of light: ray queries on the scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "sunlit/light/geometry.h"

namespace sunlit::light {

/// Rays as separate arrays of `count` values. Directions need not be unit vectors.
struct Rays {
  const float* origin_x;  ///< m in `map`
  const float* origin_y;
  const float* origin_z;
  const float* direction_x;
  const float* direction_y;
  const float* direction_z;
  std::size_t count;
};

/// Where a ray meets the scene first.
struct Hit {
  static constexpr std::uint32_t kMiss = 0xffffffffu;
  std::uint32_t triangle = kMiss;  ///< index into Geometry::triangles; kMiss: nothing along the ray
  float u = 0.0f, v = 0.0f;        ///< the point is (1 − u − v) · a + u · b + v · c of its corners
  float distance = 0.0f;           ///< in lengths of the ray's direction
};

/// Whether a surface is a clear sheet: see scene::Material::glass. What is cut out or blends is none.
inline bool isGlass(const scene::Material& material) {
  return material.glass > 0.0f && material.alpha_mode == scene::AlphaMode::kOpaque;
}
/// Whether what lies behind a surface is seen, too.
inline bool seenThrough(const scene::Material& material) {
  return material.alpha_mode == scene::AlphaMode::kBlend || isGlass(material);
}

/// Materials of AlphaMode::kMask let light through where the image shows them cut out; those of kBlend stop
/// a share alpha of the rays, by a hash of where they meet them, or none if so wished and alpha is the same
/// everywhere. Glass stops none. What they take of the light of rays that they do not stop is for those to
/// ask who add it up, by veils(). Surfaces stop light from both sides. Immutable after construction; queries
/// may run on many threads at once and give the same bits on any number.
class Visibility {
 public:
  /// Keeps `geometry` alive. Throws std::runtime_error if the ray library fails.
  explicit Visibility(std::shared_ptr<const Geometry> geometry);
  /// All that `fixed` knows, with `moving` beside it, whose triangles are numbered after those of `fixed`.
  /// Quickly made for a few thousand triangles. `fixed` is none of this kind itself.
  Visibility(std::shared_ptr<const Visibility> fixed, std::shared_ptr<const Geometry> moving);
  /// All that `other` knows, where nothing moves, of its triangles in another state of their surfaces, which
  /// stops the same rays: what rays need is shared. `geometry` differs by its weathering alone.
  Visibility(const Visibility& other, std::shared_ptr<const Geometry> geometry);
  ~Visibility();
  Visibility(const Visibility&) = delete;
  Visibility& operator=(const Visibility&) = delete;

  /// What becomes of rays at what blends evenly, by one alpha.
  enum class Blends { kStopByChance, kLetPass };
  /// Sets blocked[i] to 1 where anything lies along ray i at any distance, else to 0. Fastest for similar
  /// neighbours.
  void occluded(const Rays& rays, std::uint8_t* blocked, Blends blends = Blends::kStopByChance) const;
  /// The same of what lies between a ray's origin and origin + direction.
  void occludedWithin(const Rays& rays, std::uint8_t* blocked, Blends blends = Blends::kStopByChance) const;
  /// The first of them of what moves alone; nothing, where there is nothing that moves.
  void occludedByMoving(const Rays& rays, std::uint8_t* blocked) const;
  /// What stands still, and what moves, whose triangles are numbered after those; null: nothing moves.
  const Geometry& fixedGeometry() const;
  const Geometry* movingGeometry() const;
  /// Triangles that stand still: the number of the first one that moves.
  std::uint32_t fixedTriangles() const;

  /// Sets hits[i] to what ray i meets first, from whichever side.
  void closest(const Rays& rays, Hit* hits, Blends blends = Blends::kStopByChance) const;

  /// The triangle (index into Geometry::triangles) that a camera at `origin` sees first along `direction`, at
  /// least `near` times its length away; a one-sided triangle is invisible from behind, and what blends is
  /// seen through. Empty if there is none.
  std::optional<std::uint32_t> firstSeen(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                                         float near) const;

  /// A ray of a camera: from `near` to `far` times the length of its direction.
  struct Sight {
    Eigen::Vector3f origin, direction;
    float near, far;
    bool backs = false;  ///< counts one-sided triangles from behind too, as light does and eyes do not
  };
  /// What blends along it and glass, nearest first, at most kMostVeils.
  static constexpr std::size_t kMostVeils = 16;
  void veils(const Sight& sight, std::vector<Hit>* hits) const;
  /// Whether anything blends or is glass at all, and whether anything is glass.
  bool hasVeils() const;
  bool hasGlass() const;
  /// Whether anything blends evenly, and whether a veil does.
  bool hasEvenBlends() const;
  /// Whether any of these, or any glass, takes more than a fifth of the light in some channel.
  bool hasDarkVeils() const;
  bool blendsEvenly(const Hit& veil) const;

 private:
  void occluded(const Rays& rays, float reach, Blends blends, std::uint8_t* blocked) const;

  class Implementation;
  std::shared_ptr<const Visibility> fixed_;  ///< null: there is nothing else
  std::shared_ptr<const Geometry> geometry_;
  std::shared_ptr<const Implementation> implementation_;
};

}  // namespace sunlit::light
