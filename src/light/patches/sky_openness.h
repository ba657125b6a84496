/// How much of the sky is open, by a few sectors of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace sunlit::light {

/// How much of the sky a point sees, by sectors of it: for leaves, which differ within less than the distance
/// of nodes.
struct SkyOpenness {
  static constexpr std::size_t kSectors = 24;    ///< SkySectors tells where they lie
  std::array<std::uint8_t, kSectors> open = {};  ///< share that is not hidden, 255 for all
  bool known = false;                            ///< else the nodes tell
  /// Where it is on its triangle: barycentric coordinates, for those who ask by finer parts of the sky.
  std::array<float, 3> within = {};
};

}  // namespace sunlit::light
