#include <console_bridge/console.h>

#include <sdf/Console.hh>

#include "scene/sdf_console.h"

namespace sunlit::scene {

SdfConsole::SdfConsole() {
  sdf::Console::ConsoleStream& stream = sdf::Console::Instance()->GetMsgStream();
  put_back_ = [&stream, before = stream.GetStream()] { stream.SetStream(before); };
  stream.SetStream(&text_);
  console_bridge::noOutputHandler();
}

SdfConsole::~SdfConsole() {
  put_back_();
  console_bridge::restorePreviousOutputHandler();
}

std::vector<std::string> SdfConsole::errors() const {
  return {};
}

}  // namespace sunlit::scene
