/// Which place along the path a stamp stands for.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "sunlit/evaluate/run/pose_range.h"

namespace sunlit::evaluate {

/// Three rules, the first that applies: by `stamp_start` and `frame_rate` where a rate is given; as the
/// captures say, once any capture came; else by the order of the stamps, as the expected poses follow each
/// other.
class PoseIndex {
 public:
  /// `frame_rate` in Hz; 0: not given.
  PoseIndex(double frame_rate, std::int64_t stamp_start_ns, const PoseRange& expected = {});

  /// A capture said so.
  void learn(std::int64_t stamp_ns, std::int64_t pose);
  /// An earlier run said so; only used where neither rate nor capture does.
  void remember(std::int64_t stamp_ns, std::int64_t pose);
  /// The pose, or nothing while it is still to be learnt from a capture, and for a stamp before the start. By
  /// order, stamps are numbered as they first appear here; settled() puts that right.
  std::optional<std::int64_t> of(std::int64_t stamp_ns);
  /// The pose once all stamps are known; by order: the rank of the stamp. Nothing for one that is of no image
  /// as far as known, or before the start.
  std::optional<std::int64_t> known(std::int64_t stamp_ns) const;
  std::int64_t settled(std::int64_t stamp_ns, std::int64_t fallback) const {
    return known(stamp_ns).value_or(fallback);
  }
  bool hasRate() const { return frame_rate_ > 0.0; }
  /// Whether a place of one stamp counts before an earlier one of `other_ns`, of the same pose: by a rate
  /// where it is nearer to the stamp that this gives the pose, or as near and not later; else always.
  bool isNearer(std::int64_t stamp_ns, std::int64_t other_ns) const;

 private:
  std::optional<std::int64_t> byRate(std::int64_t stamp_ns) const;

  double frame_rate_;
  std::int64_t stamp_start_ns_;
  PoseRange expected_;
  std::map<std::int64_t, std::int64_t> learnt_;
  std::map<std::int64_t, std::int64_t> by_appearance_;
  std::int64_t next_;
};

}  // namespace sunlit::evaluate
