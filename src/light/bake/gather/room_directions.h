/// Where samples in rooms look.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sunlit::light {

/// Directions all around, some of which are looked along first.
struct RoomDirections {
  /// So many directions stand in the place of one where what is open or outdoors ends: most of a room's light
  /// may come through a window that takes a hundredth of all that is seen.
  static constexpr std::size_t kFine = 8;

  struct Direction {
    Eigen::Vector3f towards;  ///< unit
    int patch;                ///< of SkyPatches
  };

  /// Of `count` that are looked along first.
  explicit RoomDirections(std::size_t count);

  std::vector<Direction> coarse, fine;
  std::vector<std::uint32_t> first_fine;            ///< of those nearest to each coarse one; and the end
  std::vector<std::uint32_t> beside, first_beside;  ///< other coarse ones about each; and the end
};

}  // namespace sunlit::light
