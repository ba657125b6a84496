/// An order in which neighbours in space mostly follow each other (Morton 1966).
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace sunlit::light {

/// Two zero bits between any two bits of the lowest 21.
inline std::uint64_t spreadBits(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffffull;
  x = (x | x << 16) & 0x1f0000ff0000ffull;
  x = (x | x << 8) & 0x100f00f00f00f00full;
  x = (x | x << 4) & 0x10c30c30c30c30c3ull;
  return (x | x << 2) & 0x1249249249249249ull;
}

/// The place in that order of the cube with edges of `cell_m` that `position` lies in, within 2^20 cubes of
/// the origin.
inline std::uint64_t mortonCode(const Eigen::Vector3f& position, float cell_m) {
  const Eigen::Vector3i cell = (position / cell_m).array().floor().cast<int>();
  return spreadBits(static_cast<std::uint64_t>(cell.x() + (1 << 20))) |
         spreadBits(static_cast<std::uint64_t>(cell.y() + (1 << 20))) << 1 |
         spreadBits(static_cast<std::uint64_t>(cell.z() + (1 << 20))) << 2;
}

}  // namespace sunlit::light
