#include "evaluate/run/pose_index.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <utility>

namespace sunlit::evaluate {

PoseIndex::PoseIndex(double frame_rate, std::int64_t stamp_start_ns, const PoseRange& expected)
    : frame_rate_(frame_rate), stamp_start_ns_(stamp_start_ns), expected_(expected), next_(expected.first) {}

void PoseIndex::learn(std::int64_t stamp_ns, std::int64_t pose) {
  learnt_[stamp_ns] = pose;
}

void PoseIndex::remember(std::int64_t stamp_ns, std::int64_t pose) {
  by_appearance_[stamp_ns] = pose;
  next_ = std::max(next_, pose + expected_.stride);
}

std::optional<std::int64_t> PoseIndex::byRate(std::int64_t stamp_ns) const {
  const std::int64_t pose =
      std::llround(static_cast<double>(stamp_ns - stamp_start_ns_) * 1e-9 * frame_rate_);
  if (pose < 0) return std::nullopt;
  return pose;
}

std::optional<std::int64_t> PoseIndex::of(std::int64_t stamp_ns) {
  if (hasRate()) return byRate(stamp_ns);
  if (!learnt_.empty()) {
    const auto found = learnt_.find(stamp_ns);
    if (found == learnt_.end()) return std::nullopt;
    return found->second;
  }
  const auto inserted = by_appearance_.emplace(stamp_ns, next_);
  if (inserted.second) next_ += expected_.stride;
  return inserted.first->second;
}

std::optional<std::int64_t> PoseIndex::known(std::int64_t stamp_ns) const {
  if (hasRate()) return byRate(stamp_ns);
  if (!learnt_.empty()) {
    const auto found = learnt_.find(stamp_ns);
    if (found == learnt_.end()) return std::nullopt;
    return found->second;
  }
  const auto found = by_appearance_.find(stamp_ns);
  if (found == by_appearance_.end()) return std::nullopt;
  return expected_.at(static_cast<std::size_t>(std::distance(by_appearance_.begin(), found)));
}

bool PoseIndex::isNearer(std::int64_t stamp_ns, std::int64_t other_ns) const {
  if (!hasRate()) return true;
  const auto miss = [&](std::int64_t stamp) {
    const double pose = static_cast<double>(byRate(stamp).value_or(0));
    return std::abs(stamp - stamp_start_ns_ - std::llround(1e9 * pose / frame_rate_));
  };
  return std::make_pair(miss(stamp_ns), stamp_ns) <= std::make_pair(miss(other_ns), other_ns);
}

}  // namespace sunlit::evaluate
