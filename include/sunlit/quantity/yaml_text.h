/// Any text as one word of a YAML file, on one line, and back.
#pragma once

#include <cstddef>
#include <string>

namespace sunlit {

/// `text` in single quotes; in double ones where something must be escaped: control characters, Unicode's
/// line breaks, and bytes that are not UTF-8, which readers of YAML take for the characters of Latin-1.
std::string yamlQuoted(const std::string& text);

/// The text of the word that yamlQuoted() wrote at `line`[*position], to the byte; `*position` is then behind
/// it. Of a word that breaks off, what is there of it.
std::string yamlUnquoted(const std::string& line, std::size_t* position);

}  // namespace sunlit
