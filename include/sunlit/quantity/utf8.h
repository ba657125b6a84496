/// Text of files, which is UTF-8.
#pragma once

#include <string>

namespace sunlit {

/// `text`, all of `file` or its first line, without the byte order mark that some editors put at its start.
/// Throws std::runtime_error, naming `file`, for UTF-16 and UTF-32, as Windows' PowerShell writes by >.
std::string utf8Of(std::string text, const std::string& file);

}  // namespace sunlit
