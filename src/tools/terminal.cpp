#include "tools/terminal.h"

#include <cstdio>
#include <memory>

namespace sunlit::tools {

namespace {

/// One line that is written over; silent for a bake of a moment.
class ProgressLine {
 public:
  ProgressLine() = default;
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine() { end(); }

  void show(double share, double seconds_left) {
    const int percent = static_cast<int>(100.0 * share);
    if (percent == percent_ || (!shown_ && seconds_left < 1.0)) return;
    percent_ = percent;
    shown_ = true;
    std::fprintf(stderr, "\rbaking light: %d %%, %.0f s left   ", percent, seconds_left);
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

}  // namespace

studio::Reports onTerminal() {
  const auto line = std::make_shared<ProgressLine>();
  studio::Reports reports;
  reports.warning = [line](const std::string& text) {
    line->end();
    std::fprintf(stderr, "warning: %s\n", text.c_str());
  };
  reports.baking = [line](double share, double seconds_left) { line->show(share, seconds_left); };
  return reports;
}

}  // namespace sunlit::tools
