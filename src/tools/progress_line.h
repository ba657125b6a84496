/// One line at a terminal that is written over.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

#include "sunlit/quantity/duration.h"

namespace sunlit::tools {

/// "baking light: 40 %, 12 s left" on stderr; silent for a work of a moment.
class ProgressLine {
 public:
  ProgressLine() = default;
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() { end(); }

  /// `seconds_left`: NaN where nobody can tell yet.
  void show(const std::string& work, double share, double seconds_left) {
    const int percent = static_cast<int>(100.0 * share);
    constexpr std::chrono::seconds kMoment(1);
    if (percent_ < 0) begin_ = Clock::now();
    const bool lasts = seconds_left >= 1.0 || Clock::now() - begin_ >= kMoment;
    if (percent == percent_ || (!shown_ && !lasts)) return;
    percent_ = percent;
    shown_ = true;
    std::fprintf(stderr, "\r%s: %d %%%s      ", work.c_str(), percent, textOfTimeLeft(seconds_left).c_str());
  }
  /// What follows stands below it.
  void end() {
    if (shown_) std::fputc('\n', stderr);
    shown_ = false;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_;  ///< of the work
  int percent_ = -1;
  bool shown_ = false;
};

}  // namespace sunlit::tools
