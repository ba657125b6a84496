/// What libsdformat prints, kept for messages.
#pragma once

#include <functional>
#include <sstream>
#include <string>
#include <vector>

namespace sunlit::scene {

/// Keeps what libsdformat would print, for as long as it lives. What it cannot read it tries as a robot
/// description; the complaints about that are of no use to anyone and go nowhere.
class SdfConsole {
 public:
  SdfConsole();
  ~SdfConsole();
  SdfConsole(const SdfConsole&) = delete;
  SdfConsole& operator=(const SdfConsole&) = delete;

  /// Line by line, without colours, and places in libsdformat's own source and in the text that it was given.
  std::vector<std::string> lines() const;
  /// Those of them that are errors, where libsdformat (9) tells of errors in no other way.
  std::vector<std::string> errors() const;

 private:
  std::ostringstream text_;
  std::function<void()> put_back_;  ///< what was there before
};

}  // namespace sunlit::scene
