/// The sphere as a square, for tables by direction.
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace sunlit::sky {

/// Octahedral map of the sphere onto the square [−1, 1]²: Cigolle et al. 2014, listing 1. Upper hemisphere in
/// the middle. `n` of any length but 0.
inline Eigen::Vector2f octahedralPlace(const Eigen::Vector3f& n) {
  const float scale = 1.0F / (std::abs(n.x()) + std::abs(n.y()) + std::abs(n.z()));
  const float x = n.x() * scale;
  const float y = n.y() * scale;
  if (n.z() >= 0.0F) {
    return {x, y};
  }
  return {std::copysign(1.0F - std::abs(y), x), std::copysign(1.0F - std::abs(x), y)};
}

/// The unit vector whose octahedralPlace() is (x, y), each −1 … 1.
inline Eigen::Vector3f octahedralDirection(float x, float y) {
  Eigen::Vector3f n(x, y, 1.0F - std::abs(x) - std::abs(y));
  if (n.z() < 0.0F) {
    n.x() = std::copysign(1.0F - std::abs(y), x);
    n.y() = std::copysign(1.0F - std::abs(x), y);
  }
  return n.normalized();
}

}  // namespace sunlit::sky
