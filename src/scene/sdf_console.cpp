#include "scene/sdf_console.h"

#include <regex>

namespace sunlit::scene {

std::vector<std::string> SdfConsole::lines() const {
  const std::regex colors("\x1b\\[[0-9;]*m");
  const std::regex prefix("^[A-Za-z]+ \\[[^\\]]*\\] *(\\[.*:L[0-9]+\\]: *)?");
  std::vector<std::string> printed;
  std::istringstream text(std::regex_replace(text_.str(), colors, ""));
  for (std::string line; std::getline(text, line);) {
    line = std::regex_replace(line, prefix, "");
    if (!line.empty()) printed.push_back(line);
  }
  return printed;
}

}  // namespace sunlit::scene
