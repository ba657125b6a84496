#include "evaluate/run/stamp_sets.h"

#include <algorithm>
#include <utility>

namespace sunlit::evaluate {

namespace {

std::size_t reservedFor(const StampSet& set) {
  std::size_t largest = 0;
  for (const Arrival& arrival : set.streams) largest = std::max(largest, bytesOf(arrival.rgb));
  return largest * set.streams.size();
}

}  // namespace

StampSets::StampSets(std::size_t stream_count) : seen_(stream_count), newest_(stream_count) {}

bool StampSets::isOutOfOrder(std::size_t stream, std::int64_t stamp_ns) const {
  return newest_.at(stream) && stamp_ns < *newest_[stream];
}

std::optional<std::int64_t> StampSets::onlyStamp(std::size_t stream) const {
  if (seen_.at(stream).size() != 1) return std::nullopt;
  return *seen_[stream].begin();
}

StampSets::Outcome StampSets::add(std::size_t stream, std::int64_t stamp_ns, Arrival arrival) {
  auto& newest = newest_.at(stream);
  newest = std::max(newest.value_or(stamp_ns), stamp_ns);
  const bool is_first = seen_[stream].insert(stamp_ns).second;
  if (taken_.count(stamp_ns) != 0) return is_first ? Outcome::kClosed : Outcome::kDuplicate;

  StampSet& set = open_[stamp_ns];
  if (set.streams.empty()) {
    set.stamp_ns = stamp_ns;
    set.streams.resize(seen_.size());
  }
  Arrival& slot = set.streams[stream];
  if (!is_first && (!slot.rgb.empty() || arrival.rgb.empty())) return Outcome::kDuplicate;
  reserved_bytes_ -= reservedFor(set);
  slot = std::move(arrival);
  slot.has_come = true;
  reserved_bytes_ += reservedFor(set);
  if (!slot.rgb.empty()) ++waiting_images_;
  return is_first ? Outcome::kKept : Outcome::kReplaced;
}

const StampSet* StampSets::find(std::int64_t stamp_ns) const {
  const auto found = open_.find(stamp_ns);
  return found == open_.end() ? nullptr : &found->second;
}

StampSet StampSets::take(std::int64_t stamp_ns) {
  const auto found = open_.find(stamp_ns);
  StampSet set = std::move(found->second);
  open_.erase(found);
  taken_.insert(stamp_ns);
  reserved_bytes_ -= reservedFor(set);
  for (const Arrival& arrival : set.streams) waiting_images_ -= arrival.rgb.empty() ? 0 : 1;
  return set;
}

std::vector<std::int64_t> StampSets::openStamps() const {
  std::vector<std::int64_t> stamps;
  for (const auto& item : open_) stamps.push_back(item.first);
  return stamps;
}

std::optional<std::int64_t> StampSets::oldest() const {
  if (open_.empty()) return std::nullopt;
  return open_.begin()->first;
}

}  // namespace sunlit::evaluate
