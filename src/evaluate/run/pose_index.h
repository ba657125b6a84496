/// Which place along the path a stamp stands for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "sunlit/evaluate/run/pose_range.h"

namespace sunlit::evaluate {

/// Three rules, the first that applies: by `stamp_start` and `frame_rate` where a rate is given; as the
/// captures say, once there is one of a stamp that an image has; else by the order of the stamps, as the
/// expected poses follow each other. That is only known at the end, so that what must know a pose earlier
/// rules it out. Numbers by order are forgotten once captures count: a stamp then has the pose of its own, or
/// none.
class PoseIndex {
 public:
  /// `frame_rate` in Hz; 0: not given. `by_order`: the third rule may apply.
  PoseIndex(double frame_rate, std::int64_t stamp_start_ns, const PoseRange& expected, bool by_order);

  /// A capture said so: of an image, or of none, which tells nothing of any other.
  void learn(std::int64_t stamp_ns, std::int64_t pose);
  /// What the latest capture of a stamp said.
  std::optional<std::int64_t> told(std::int64_t stamp_ns) const;
  /// An earlier run said so; only used where neither rate nor capture does. Of several the first counts.
  void remember(std::int64_t stamp_ns, std::int64_t pose);
  /// All is remembered. Numbers stay, as pictures bear them; but each of several runs may have begun at 0, or
  /// expected others: then they become ranks.
  void settleRemembered();
  /// The pose, or nothing while it is still to be learnt from a capture, and for a stamp before the start. By
  /// order, stamps, which are those of images, get the next number that is free as they first appear here;
  /// rank() puts that right.
  std::optional<std::int64_t> of(std::int64_t stamp_ns);
  /// All stamps are known: by order, numbers become ranks.
  void rank();
  /// The same as of(), but by order nothing for a stamp that is of no image as far as known.
  std::optional<std::int64_t> known(std::int64_t stamp_ns) const;
  /// What is known of the pose of something that was given `number`: that number where this does not know
  /// better; nothing where it was one by order, and captures tell poses by now, but not this one.
  std::optional<std::int64_t> settled(std::int64_t stamp_ns, std::int64_t number) const;
  bool hasRate() const { return frame_rate_ > 0.0; }
  /// Numbers that of() gives are by order, as long as no capture of an image comes.
  bool isByOrder() const { return by_order_ && !hasRate() && !is_by_capture_; }
  bool isByCapture() const { return !hasRate() && is_by_capture_; }
  /// How many stamps captures told that are of no image, where none is.
  std::size_t strayCaptures() const { return isByOrder() ? learnt_.size() : 0; }
  /// The earliest and the latest stamp that have a number by order.
  std::optional<std::pair<std::int64_t, std::int64_t>> numberedStamps() const;
  /// It was given a number by order before captures counted.
  bool wasByOrder(std::int64_t stamp_ns) const { return isByCapture() && numbered_.count(stamp_ns) != 0; }
  /// Whether a place of one stamp counts before an earlier one of `other_ns`, of the same pose: by a rate
  /// where it is nearer to the stamp that this gives the pose, or as near and not later; else always.
  bool isNearer(std::int64_t stamp_ns, std::int64_t other_ns) const;

 private:
  std::optional<std::int64_t> byRate(std::int64_t stamp_ns) const;

  double frame_rate_;
  std::int64_t stamp_start_ns_;
  PoseRange expected_;
  std::map<std::int64_t, std::int64_t> learnt_;
  bool is_by_capture_ = false;
  bool by_order_;
  std::map<std::int64_t, std::int64_t> numbered_;  // by order
  std::set<std::int64_t> remembered_;              // numbers
  std::int64_t next_;                              // number
};

}  // namespace sunlit::evaluate
