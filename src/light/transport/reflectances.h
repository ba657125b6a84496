/// How much light surfaces send back, on average over a neighbourhood.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sunlit/light/geometry.h"

namespace sunlit::light {

class Reflectances {
 public:
  /// Keeps a reference.
  explicit Reflectances(const Geometry& geometry);
  /// Share of the arriving light that leaves again, diffuse and mirrored, at a point of a triangle; of masked
  /// surfaces the solid part.
  Eigen::Array3f at(std::uint32_t triangle, const Eigen::Vector3f& barycentric) const;

 private:
  /// A texture averaged over kSize × kSize squares, linear.
  struct Thumbnail {
    static constexpr int kSize = 32;
    std::vector<Eigen::Array3f> pixels;
  };
  static Thumbnail shrink(const scene::Texture& texture);

  const Geometry& geometry_;
  std::vector<Thumbnail> thumbnails_;
};

}  // namespace sunlit::light
