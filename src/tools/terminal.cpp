#include "tools/terminal.h"

#include <cstdio>
#include <memory>
#include <string>

#include "tools/progress_line.h"

namespace sunlit::tools {

studio::Reports onTerminal() {
  const auto line = std::make_shared<ProgressLine>();
  studio::Reports reports;
  reports.warning = [](const std::string& text) {
    ProgressLine::leave();
    std::fprintf(stderr, "warning: %s\n", text.c_str());
  };
  const auto world = std::make_shared<std::string>();
  reports.note = [world](const std::string& text) {
    if (world->empty()) *world = text;
  };
  reports.baking = [line, world](double share, double seconds_left) {
    line->show("baking light", share, seconds_left, {*world, " (--bounced off: without it)"});
  };
  return reports;
}

}  // namespace sunlit::tools
