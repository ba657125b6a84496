/// Names in one line of a message.
#pragma once

#include <string>

namespace sunlit {

/// "a, b, c" of a container of texts; empty where it is.
template <typename Texts>
std::string commaList(const Texts& texts) {
  std::string line;
  bool is_first = true;
  for (const std::string& text : texts) {
    line += (is_first ? "" : ", ") + text;
    is_first = false;
  }
  return line;
}

}  // namespace sunlit
