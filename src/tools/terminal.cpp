#include "tools/terminal.h"

#include <cstdio>
#include <memory>

#include "tools/progress_line.h"

namespace sunlit::tools {

studio::Reports onTerminal() {
  const auto line = std::make_shared<ProgressLine>();
  studio::Reports reports;
  reports.warning = [](const std::string& text) {
    ProgressLine::leave();
    std::fprintf(stderr, "warning: %s\n", text.c_str());
  };
  reports.baking = [line](double share, double seconds_left) {
    line->show("baking light", share, seconds_left);
  };
  return reports;
}

}  // namespace sunlit::tools
