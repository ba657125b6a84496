/// Text as Windows' PowerShell writes it by >.
#pragma once

#include <string>

namespace sunlit {

/// `text`, of letters of ASCII, with its byte order mark, the lower bytes first.
inline std::string utf16Of(const std::string& text) {
  std::string wide = "\xFF\xFE";
  for (const char letter : text) {
    wide += letter;
    wide += '\0';
  }
  return wide;
}

/// What is said of such a file.
inline std::string refusalOfUtf16(const std::string& file) {
  return file + ": this is text in UTF-16 or UTF-32: save it as UTF-8";
}

}  // namespace sunlit
