/// One line at a terminal that is written over.
#pragma once

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

  void show(const std::string& work, double share, double seconds_left) {
    const int percent = static_cast<int>(100.0 * share);
    if (percent == percent_ || (!shown_ && seconds_left < 1.0)) return;
    percent_ = percent;
    shown_ = true;
    std::fprintf(stderr, "\r%s: %d %%, %s left      ", work.c_str(), percent,
                 textOfDuration(seconds_left).c_str());
  }
  /// What follows stands below it.
  void end() {
    if (shown_) std::fputc('\n', stderr);
    shown_ = false;
  }

 private:
  int percent_ = -1;
  bool shown_ = false;
};

}  // namespace sunlit::tools
