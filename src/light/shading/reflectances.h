/// How much light surfaces send back, on average over a neighbourhood.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "light/geometry/triangle_side.h"
#include "light/shading/thumbnail.h"
#include "sunlit/light/geometry.h"

namespace sunlit::light {

/// What of a surface decides how it reflects, by itself or as a mean by area.
struct Paint {
  Eigen::Array3f albedo = Eigen::Array3f::Zero();
  float roughness = 0.0f, metalness = 0.0f;
  /// As of scene::Material: what it reflects at normal incidence where it is no metal, and at grazing.
  Eigen::Array3f dielectric = Eigen::Array3f::Zero();
  float dielectric_grazing = 0.0f;

  /// At normal incidence, of luminance; and at grazing.
  float normalReflectance() const;
  float grazingReflectance() const { return dielectric_grazing + (1.0f - dielectric_grazing) * metalness; }
  Paint& operator+=(const Paint& other);
  Paint& operator*=(float factor);
};
inline Paint operator*(float factor, Paint paint) {
  return paint *= factor;
}

/// Never quite all of what arrives, so that light dies out.
constexpr float kMostReflected = 0.98f;

/// Share of the arriving light that leaves again towards an eye.
struct Reflectance {
  Eigen::Array3f diffuse, mirrored;
  Eigen::Array3f all() const { return (diffuse + mirrored).min(kMostReflected); }
};
/// `n_v`: cosine between normal and eye. Without transmission.
Reflectance reflectance(const Paint& paint, float n_v);
/// The mean over all views, by cosine: what becomes of light from all around as a whole. At grazing angles
/// even rough surfaces mirror several times as much as at any other.
Reflectance meanReflectance(const Paint& paint);

class Reflectances {
 public:
  /// Keeps a reference.
  explicit Reflectances(const Geometry& geometry);

  /// Part of a triangle: its corners' barycentric coordinates, a column each.
  using Part = Eigen::Matrix3f;

  /// At a point of a triangle; of masked surfaces the solid part.
  Paint at(const TriangleSide& side, const Eigen::Vector3f& barycentric) const;
  /// Of a part, about: by some points of it where its textures differ within.
  Paint mean(const TriangleSide& side, const Part& part) const;
  /// Luminance of its own at a point of a triangle, cd/m².
  Eigen::Array3f emissionAt(std::uint32_t triangle, const Eigen::Vector3f& barycentric) const;
  /// The same of a part: the mean in the same way.
  Eigen::Array3f emission(std::uint32_t triangle, const Part& part) const;

 private:
  /// Textures of a material, by their numbers in thumbnails_.
  struct Textures {
    static constexpr int kNone = -1;
    int base = kNone, roughness = kNone, metalness = kNone, emission = kNone;
  };
  struct Wanted {
    int texture;
    Thumbnail::Kind kind;
  };
  int numberOf(const scene::TextureUse& use, Thumbnail::Kind kind, std::vector<Wanted>* wanted) const;

  /// How a triangle shows a texture.
  struct Shown {
    const Thumbnail* thumbnail = nullptr;  ///< null: it shows none
    int set = 0;                           ///< of texture coordinates
    int channel = 0;
    Thumbnail::Grain grain = Thumbnail::Grain::kSquares;
  };
  /// All that decides how it reflects.
  struct ShownPaint {
    Shown base, roughness, metalness;
  };
  Shown shown(int thumbnail, const scene::TextureUse& use, std::uint32_t triangle) const;
  ShownPaint shownPaint(std::uint32_t triangle) const;
  /// Value there, and the share that is solid; 1 without a texture.
  Eigen::Array4f look(const Shown& of, std::uint32_t triangle, const Eigen::Vector3f& barycentric) const;
  /// How many squares or texels of it a part runs over, along the axis where these are most.
  float cells(const Shown& of, std::uint32_t triangle, const Part& part) const;

  /// Before water and snow, and how much of it is solid.
  struct Dry {
    Paint paint;
    float solid;
  };
  Dry dry(const ShownPaint& shows, std::uint32_t triangle, const Eigen::Vector3f& barycentric) const;
  /// What water and snow make of it.
  Paint weathered(const Paint& paint, const TriangleSide& side, const Eigen::Vector3f& barycentric) const;
  const scene::Material& materialOf(std::uint32_t triangle) const;
  const Textures& texturesOf(std::uint32_t triangle) const;
  Eigen::Vector2f coordinates(std::uint32_t triangle, const Eigen::Vector3f& barycentric, int set) const;

  const Geometry& geometry_;
  std::vector<Textures> of_materials_;
  std::vector<Thumbnail> thumbnails_;
};

}  // namespace sunlit::light
