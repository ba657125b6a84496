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

}  // namespace sunlit::scene
