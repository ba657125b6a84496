/// Which pose of an estimate belongs to which of the truth.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sunlit/evaluate/trajectory/trajectory.h"

namespace sunlit::evaluate {

struct Association {
  struct Pair {
    std::size_t truth = 0, estimate = 0;  ///< indices
  };
  std::vector<Pair> pairs;  ///< in the order of time, in both
  /// Indices of poses without a partner.
  std::vector<std::size_t> truth_left, estimate_left;
};

/// Pairs by time, one to one. Each pose of the trajectory with fewer poses (of two of one size, the estimate)
/// asks for that of the other which is nearest in time, the earlier of two that are equally near; of several
/// that ask for the same one, the nearest has it, the earliest of equally near ones, and the others have
/// none. Nearest is at most `max_difference_ns` (≥ 0) away, or there is none. So does evo 1.x, but for giving
/// one pose to several.
Association associate(const Trajectory& truth, const Trajectory& estimate, std::int64_t max_difference_ns);

/// The least time between a pose of one and a pose of the other, s. Neither is empty.
double leastDifference(const Trajectory& truth, const Trajectory& estimate);

}  // namespace sunlit::evaluate
