/// What the sequence numbers of one sender tell of images that did not come.
#pragma once

#include <algorithm>
#include <cstdint>

namespace sunlit::ros_interface {

/// Senders number their messages one by one; throttles, and bags of what they left, keep the numbers. So the
/// smallest step between two numbers is what the stream does, and larger ones are gaps. A lower number is a
/// sender that began anew.
class SequenceGaps {
 public:
  /// So many images are missing before that of a stamp.
  struct Gap {
    std::uint32_t images = 0;  ///< 0: none
    std::int64_t stamp_ns = 0;
  };

  /// To be called with each message in turn. The first step says nothing by itself: its gap comes with the
  /// second.
  Gap add(std::uint32_t number, std::int64_t stamp_ns) {
    const bool is_next = has_last_ && number > last_;
    const std::uint32_t step = number - last_;
    has_last_ = true;
    last_ = number;
    if (!is_next) return {};
    const bool is_first = smallest_ == 0;
    smallest_ = is_first ? step : std::min(smallest_, step);
    if (is_first) {
      first_ = {step, stamp_ns};
      return {};
    }
    const std::uint32_t now = step / smallest_ - 1;
    const std::uint32_t before = first_.images == 0 ? 0 : first_.images / smallest_ - 1;
    const Gap gap{before + now, now > 0 ? stamp_ns : first_.stamp_ns};
    first_ = {};
    return gap;
  }

 private:
  bool has_last_ = false;
  std::uint32_t last_ = 0;
  std::uint32_t smallest_ = 0;  // step; 0: none was seen
  Gap first_;                   // step, while it is the only one
};

}  // namespace sunlit::ros_interface
