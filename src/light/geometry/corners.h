/// Points on triangles.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "sunlit/light/geometry.h"

namespace sunlit::light {

/// A triangle, ready for points on it.
class Corners {
 public:
  Corners(const Geometry& geometry, std::uint32_t triangle)
      : first_(geometry.positions[geometry.triangles[triangle][0]]) {
    const auto& corners = geometry.triangles[triangle];
    // Long thin triangles leave a small difference of large products: a kerb of 100 m × 5 cm needs more than
    // single precision.
    const Eigen::Vector3d ab = (geometry.positions[corners[1]] - first_).cast<double>();
    const Eigen::Vector3d ac = (geometry.positions[corners[2]] - first_).cast<double>();
    const double bb = ab.squaredNorm(), cc = ac.squaredNorm(), bc = ab.dot(ac);
    const double scale = 1.0 / std::max(bb * cc - bc * bc, 1e-30);
    towards_second_ = (scale * (cc * ab - bc * ac)).cast<float>();
    towards_third_ = (scale * (bb * ac - bc * ab)).cast<float>();
  }
  /// Barycentric coordinates of the point of its plane nearest to `position`, within it. Along its longest
  /// edge they are off by what `position` is rounded by, times that edge over the triangle's height.
  std::array<float, 3> within(const Eigen::Vector3f& position) const {
    const Eigen::Vector3f along = position - first_;
    float v = std::max(along.dot(towards_second_), 0.0f), w = std::max(along.dot(towards_third_), 0.0f);
    const float sum = v + w;
    if (sum > 1.0f) v /= sum, w /= sum;
    return {std::max(1.0f - v - w, 0.0f), v, w};
  }

 private:
  Eigen::Vector3f first_, towards_second_, towards_third_;
};

/// Side of the square that is twice as large as a triangle, m.
inline float edgeOf(const Geometry& geometry, std::uint32_t triangle) {
  const auto& corners = geometry.triangles[triangle];
  const Eigen::Vector3f first = geometry.positions[corners[0]];
  const Eigen::Vector3f ab = geometry.positions[corners[1]] - first;
  const Eigen::Vector3f ac = geometry.positions[corners[2]] - first;
  return std::sqrt(ab.cross(ac).norm());
}

/// m.
inline float longestEdge(const Geometry& geometry, std::uint32_t triangle) {
  const auto& corners = geometry.triangles[triangle];
  float longest = 0.0f;
  for (std::size_t k = 0; k < 3; ++k)
    longest =
        std::max(longest, (geometry.positions[corners[k]] - geometry.positions[corners[(k + 1) % 3]]).norm());
  return longest;
}

}  // namespace sunlit::light
