/// How much light surfaces send back, on average over a neighbourhood.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "light/geometry/triangle_side.h"
#include "sunlit/light/geometry.h"

namespace sunlit::light {

/// What of a surface decides how it reflects, by itself or as a mean by area.
struct Paint {
  Eigen::Array3f albedo = Eigen::Array3f::Zero();
  float roughness = 0.0f, metalness = 0.0f;

  void add(float area, const Paint& other);
  void divide(float areas);
};

/// Share of the arriving light that leaves again towards an eye.
struct Reflectance {
  Eigen::Array3f diffuse, mirrored;
  /// Never quite all of what arrives, so that light dies out.
  Eigen::Array3f all() const { return (diffuse + mirrored).min(0.98f); }
};
/// `n_v`: cosine between normal and eye. Without transmission.
Reflectance reflectance(const Paint& paint, float n_v);
/// Seen at 50° from the normal, which is about the mean of a hemisphere.
constexpr float kMeanView = 0.64f;

class Reflectances {
 public:
  /// Keeps a reference.
  explicit Reflectances(const Geometry& geometry);
  /// At a point of a triangle; of masked surfaces the solid part.
  Paint at(const TriangleSide& side, const Eigen::Vector3f& barycentric) const;
  /// Luminance of its own there, cd/m².
  Eigen::Array3f emission(std::uint32_t triangle, const Eigen::Vector3f& barycentric) const;

 private:
  /// A texture averaged over kSize × kSize squares, linear.
  struct Thumbnail {
    static constexpr int kSize = 32;
    std::vector<Eigen::Array3f> pixels;
  };
  enum class Kind { kColor, kData };
  static Thumbnail shrink(const scene::Texture& texture, Kind kind);
  /// What water and snow make of it.
  Paint weathered(const Paint& paint, const TriangleSide& side, const Eigen::Vector3f& barycentric) const;
  Eigen::Vector2f coordinates(std::uint32_t triangle, const Eigen::Vector3f& barycentric, int set) const;
  /// Of one of `thumbnails`, at a place in the texture `texture`.
  Eigen::Array3f look(const std::vector<Thumbnail>& thumbnails, int texture, const Eigen::Vector2f& uv) const;
  /// Value of a map of data there.
  float data(const scene::TextureUse& use, std::uint32_t triangle, const Eigen::Vector3f& barycentric) const;

  const Geometry& geometry_;
  std::vector<Thumbnail> thumbnails_;
  std::vector<Thumbnail> data_thumbnails_;  ///< of those that are used as data; others are empty
};

}  // namespace sunlit::light
