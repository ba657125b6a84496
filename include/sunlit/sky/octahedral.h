/// The sphere as a square, for tables by direction.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>

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

/// Cell of a map of `side` cells an axis, row by row, that the direction (x, y, z) of any length but 0 lies
/// in: by octahedralPlace() without a branch, so that compilers may treat several directions at once.
inline std::int32_t octahedralCell(std::int32_t side, float x, float y, float z) {
  const float scale = 1.0F / (std::abs(x) + std::abs(y) + std::abs(z));
  x *= scale;
  y *= scale;
  const float folded_x = std::copysign(1.0F - std::abs(y), x),
              folded_y = std::copysign(1.0F - std::abs(x), y);
  x = z < 0.0F ? folded_x : x;
  y = z < 0.0F ? folded_y : y;
  const auto step = [&](float at) {
    const auto i = static_cast<std::int32_t>((at + 1.0F) * (0.5F * static_cast<float>(side)));
    return i < 0 ? 0 : i > side - 1 ? side - 1 : i;
  };
  return step(y) * side + step(x);
}

/// The unit vector in the middle of such a cell.
inline Eigen::Vector3f octahedralMiddle(std::int32_t side, std::size_t cell) {
  const auto middle = [&](std::size_t i) {
    return (2.0F * static_cast<float>(i) + 1.0F) / static_cast<float>(side) - 1.0F;
  };
  const auto cells = static_cast<std::size_t>(side);
  return octahedralDirection(middle(cell % cells), middle(cell / cells));
}

}  // namespace sunlit::sky
