#include "evaluate/run/pose_index.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace sunlit::evaluate {

PoseIndex::PoseIndex(double frame_rate, std::int64_t stamp_start_ns, const PoseRange& expected, bool by_order)
    : frame_rate_(frame_rate),
      stamp_start_ns_(stamp_start_ns),
      expected_(expected),
      by_order_(by_order),
      next_(expected.first) {}

void PoseIndex::learn(std::int64_t stamp_ns, std::int64_t pose) {
  learnt_[stamp_ns] = pose;
  is_by_capture_ = is_by_capture_ || !by_order_ || numbered_.count(stamp_ns) != 0;
}

std::optional<std::int64_t> PoseIndex::told(std::int64_t stamp_ns) const {
  const auto found = learnt_.find(stamp_ns);
  if (found == learnt_.end()) return std::nullopt;
  return found->second;
}

void PoseIndex::remember(std::int64_t stamp_ns, std::int64_t pose) {
  numbered_.emplace(stamp_ns, pose);
}

void PoseIndex::settleRemembered() {
  is_by_capture_ =
      is_by_capture_ || std::any_of(numbered_.begin(), numbered_.end(),
                                    [this](const auto& item) { return learnt_.count(item.first) != 0; });
  if (isByCapture()) {  // so were theirs
    numbered_.clear();
    return;
  }
  for (const auto& item : numbered_) remembered_.insert(item.second);
  const bool are_expected = std::all_of(remembered_.begin(), remembered_.end(),
                                        [this](std::int64_t pose) { return expected_.holds(pose); });
  if (are_expected && remembered_.size() == numbered_.size()) return;
  rank();
  remembered_.clear();
  next_ = expected_.at(numbered_.size());
}

void PoseIndex::rank() {
  std::size_t rank = 0;
  for (auto& item : numbered_) item.second = expected_.at(rank++);
}

std::optional<std::int64_t> PoseIndex::byRate(std::int64_t stamp_ns) const {
  const std::int64_t pose =
      std::llround(static_cast<double>(stamp_ns - stamp_start_ns_) * 1e-9 * frame_rate_);
  if (pose < 0) return std::nullopt;
  return pose;
}

std::optional<std::int64_t> PoseIndex::of(std::int64_t stamp_ns) {
  if (learnt_.count(stamp_ns) != 0) is_by_capture_ = true;
  if (isByOrder()) {
    while (remembered_.count(next_) != 0) next_ += expected_.stride;
    if (numbered_.emplace(stamp_ns, next_).second) next_ += expected_.stride;
  }
  return known(stamp_ns);
}

std::optional<std::int64_t> PoseIndex::known(std::int64_t stamp_ns) const {
  if (hasRate()) return byRate(stamp_ns);
  const auto& told = is_by_capture_ ? learnt_ : numbered_;
  const auto found = told.find(stamp_ns);
  if (found == told.end()) return std::nullopt;
  return found->second;
}

std::optional<std::pair<std::int64_t, std::int64_t>> PoseIndex::numberedStamps() const {
  if (numbered_.empty()) return std::nullopt;
  return std::make_pair(numbered_.begin()->first, numbered_.rbegin()->first);
}

std::optional<std::int64_t> PoseIndex::settled(std::int64_t stamp_ns, std::int64_t number) const {
  const std::optional<std::int64_t> pose = known(stamp_ns);
  if (pose || wasByOrder(stamp_ns)) return pose;
  return number;
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
