#include "sunlit/evaluate/trajectory/association.h"

#include <algorithm>
#include <limits>

namespace sunlit::evaluate {
namespace {

/// Unsigned, since stamps at both ends of their range are further apart than they can count.
std::uint64_t differenceOf(const StampedPose& a, const StampedPose& b) {
  const auto [low, high] = std::minmax(a.stamp_ns, b.stamp_ns);
  return static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low);
}

/// Index of the pose of `poses`, of which there is one at least, that is nearest to `pose` in time.
std::size_t nearest(const Trajectory& poses, const StampedPose& pose) {
  const auto after = std::lower_bound(
      poses.begin(), poses.end(), pose.stamp_ns,
      [](const StampedPose& candidate, std::int64_t stamp_ns) { return candidate.stamp_ns < stamp_ns; });
  if (after == poses.begin()) return 0;
  const auto before = after - 1;
  const bool is_before = after == poses.end() || differenceOf(*before, pose) <= differenceOf(*after, pose);
  return static_cast<std::size_t>((is_before ? before : after) - poses.begin());
}

std::vector<std::size_t> absentFrom(const std::vector<char>& is_paired) {
  std::vector<std::size_t> absent;
  for (std::size_t i = 0; i < is_paired.size(); ++i) {
    if (!is_paired[i]) absent.push_back(i);
  }
  return absent;
}

constexpr std::size_t kNobody = std::numeric_limits<std::size_t>::max();

}  // namespace

Association associate(const Trajectory& truth, const Trajectory& estimate, std::int64_t max_difference_ns) {
  const bool estimate_asks = estimate.size() <= truth.size();
  const Trajectory& asking = estimate_asks ? estimate : truth;
  const Trajectory& asked = estimate_asks ? truth : estimate;
  std::vector<std::size_t> holder(asked.size(), kNobody);
  for (std::size_t i = 0; i < asking.size() && !asked.empty(); ++i) {
    const std::size_t partner = nearest(asked, asking[i]);
    const std::uint64_t difference = differenceOf(asking[i], asked[partner]);
    if (difference > static_cast<std::uint64_t>(max_difference_ns)) continue;
    std::size_t& held_by = holder[partner];
    if (held_by == kNobody || difference < differenceOf(asking[held_by], asked[partner])) held_by = i;
  }
  Association result;
  std::vector<char> truth_paired(truth.size(), 0), estimate_paired(estimate.size(), 0);
  for (std::size_t partner = 0; partner < asked.size(); ++partner) {
    if (holder[partner] == kNobody) continue;
    const Association::Pair pair = estimate_asks ? Association::Pair{partner, holder[partner]}
                                                 : Association::Pair{holder[partner], partner};
    truth_paired[pair.truth] = estimate_paired[pair.estimate] = 1;
    result.pairs.push_back(pair);
  }
  result.truth_left = absentFrom(truth_paired);
  result.estimate_left = absentFrom(estimate_paired);
  return result;
}

double leastDifference(const Trajectory& truth, const Trajectory& estimate) {
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  for (const StampedPose& pose : estimate)
    least = std::min(least, differenceOf(pose, truth[nearest(truth, pose)]));
  return static_cast<double>(least) * 1e-9;
}

}  // namespace sunlit::evaluate
