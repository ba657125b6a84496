/// How far a work is, on stderr: one line at a terminal, written over, and whole lines in a file or pipe.
#pragma once

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <string>

#include "sunlit/quantity/duration.h"

namespace sunlit::tools {

/// What is told once of a work that lasts.
struct LongWork {
  std::string above = {};    ///< a line that stands above its own
  std::string way_out = {};  ///< ends its first line where more than a minute is left
};

/// "baking light: 40 %, 12 s left"; silent for a work of a moment. Of one thread.
class ProgressLine {
 public:
  ProgressLine() = default;
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() { end(); }

  /// `seconds_left`: NaN where nobody can tell yet.
  void show(const std::string& work, double share, double seconds_left, const LongWork& about = {}) {
    const int percent = static_cast<int>(100.0 * share);
    constexpr std::chrono::seconds kMoment(1);
    const Clock::time_point now = Clock::now();
    if (percent_ < 0) begin_ = now;
    const bool lasts = seconds_left >= 1.0 || now - begin_ >= kMoment;
    if (percent == percent_ || (!shown_ && !lasts)) return;
    percent_ = percent;
    if (!shown_ && !about.above.empty()) {
      leave();
      std::fprintf(stderr, "%s\n", about.above.c_str());
    }
    constexpr double kLong_s = 60.0;
    const std::string text = work + ": " + std::to_string(percent) + " %" + textOfTimeLeft(seconds_left) +
                             (!shown_ && seconds_left > kLong_s ? about.way_out : "");
    if (::isatty(STDERR_FILENO) == 1) {
      std::fprintf(stderr, "\r%s      ", text.c_str());
      is_open_ = true;
    } else if (!shown_ || now - latest_ >= kBetweenLines) {
      std::fprintf(stderr, "%s\n", text.c_str());
      latest_ = now;
    }
    shown_ = true;
  }
  /// The work has ended: what is shown next is of another one.
  void end() {
    if (shown_) leave();
    shown_ = false;
    percent_ = -1;
  }
  /// What follows on stderr stands below the line, whoever shows one.
  static void leave() {
    if (is_open_) std::fputc('\n', stderr);
    is_open_ = false;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kBetweenLines{30};
  inline static bool is_open_ = false;  ///< a line at the terminal, whose end has not been written
  Clock::time_point begin_;             ///< of the work
  Clock::time_point latest_;            ///< line in a file
  int percent_ = -1;
  bool shown_ = false;
};

}  // namespace sunlit::tools
