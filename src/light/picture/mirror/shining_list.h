/// Surfaces that shine by themselves, looked for from rough mirrors, whose rays meet small ones by chance.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "light/picture/mirror/reflections.h"
#include "light/shading/mirrored_by_rays.h"
#include "sunlit/light/geometry.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {

/// Triangles that stand still, of opaque materials, not of glass, that belong to no group of lamps: the kMost
/// that are the most powerful.
class ShiningList {
 public:
  static constexpr std::size_t kMost = 4096;

  explicit ShiningList(const Geometry& geometry);
  /// Whether a scene has any.
  static bool anyIn(const Geometry& geometry);
  bool any() const { return !all_.empty(); }

  /// A point of one of them.
  struct Point {
    Hit hit;  ///< without its distance
    Eigen::Vector3f position, normal;
    bool both_sides;
    float density;  ///< with which pick() finds it, 1/m²
  };

  /// How likely which of them is looked for, by what it may give to a box.
  class Chances {
   public:
    /// Keeps a reference to `list`. None has any for an empty box.
    Chances(const ShiningList& list, const Eigen::AlignedBox3f& box);
    /// By three numbers in [0, 1). There is at least one that may be picked where any() says so.
    Point pick(const Eigen::Vector3f& random) const;
    bool any() const { return !sums_.empty() && sums_.back() > 0.0f; }
    /// Of Point::density, of each point of a triangle; 0: none is ever picked.
    float density(std::uint32_t triangle) const;

   private:
    const ShiningList& list_;
    std::vector<float> sums_;  ///< of each and all before it
  };

 private:
  struct Shining {
    std::uint32_t triangle;
    Eigen::Vector3f middle;
    float area_m2, longest_m, power;  ///< cd straight before it, but for its texture
    bool both_sides;
  };
  float chanceOf(const Shining& one, const Eigen::AlignedBox3f& box) const;

  const Geometry& geometry_;
  std::vector<Shining> all_;
  std::unordered_map<std::uint32_t, std::uint32_t> number_;  ///< by triangle
};

/// Which surfaces of a scene mirror by rays.
inline MirrorsByRays mirrorsByRays(const Geometry& geometry, Onlooker onlooker) {
  return onlooker == Onlooker::kCamera && ShiningList::anyIn(geometry) ? kBeforePanels : kSmoothOnes;
}

}  // namespace sunlit::light
