/// What others say of a fault, as part of a line.
#pragma once

#include <string>

namespace sunlit {

/// `text` with blanks for its line breaks and other control characters.
inline std::string oneLine(std::string text) {
  constexpr char kDelete = 0x7f;
  for (char& letter : text) {
    if (static_cast<unsigned char>(letter) < ' ' || letter == kDelete) letter = ' ';
  }
  return text;
}

}  // namespace sunlit
