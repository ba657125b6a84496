/// libsdformat 9 prints to std::cerr, whatever it is told. What others print there meanwhile is taken for its
/// words.
#include <console_bridge/console.h>

#include <iostream>

#include "scene/sdf_console.h"

namespace sunlit::scene {

SdfConsole::SdfConsole() {
  put_back_ = [before = std::cerr.rdbuf(text_.rdbuf())] { std::cerr.rdbuf(before); };
  console_bridge::noOutputHandler();
}

SdfConsole::~SdfConsole() {
  put_back_();
  console_bridge::restorePreviousOutputHandler();
}

std::vector<std::string> SdfConsole::errors() const {
  std::vector<std::string> errors;
  std::istringstream text(text_.str());
  const std::vector<std::string> plain = lines();
  std::size_t i = 0;
  for (std::string line; std::getline(text, line) && i < plain.size();) {
    if (line.find(plain[i]) == std::string::npos) continue;  // of its colours alone
    if (line.find("Error [") < line.find(plain[i])) errors.push_back(plain[i]);
    ++i;
  }
  return errors;
}

}  // namespace sunlit::scene
