#include "sunlit/quantity/yaml_text.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace sunlit {
namespace {

struct Character {
  std::size_t bytes;   ///< 1 to 4; 0: no UTF-8
  std::uint32_t code;  ///< of Unicode
};

/// UTF-8 as RFC 3629 has it: the shortest form only, no surrogates.
Character characterAt(const std::string& text, std::size_t at) {
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(at);
  if (lead < 0x80) return {1, lead};
  const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc0 || lead > 0xf4 || at + bytes > text.size()) return {0, 0};
  std::uint32_t code = lead & (0x7fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(at + i) & 0xc0) != 0x80) return {0, 0};
    code = code << 6 | (byte(at + i) & 0x3f);
  }
  const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
  return code < kLeast[bytes] || is_surrogate || code > 0x10ffff ? Character{0, 0} : Character{bytes, code};
}

/// Whether a file of YAML must not hold it, or would take it for a line break (YAML 1.1, 4.1 and 4.2).
bool mustBeEscaped(std::uint32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0x2028 || code == 0x2029 || code == 0xfeff ||
         code == 0xfffe || code == 0xffff;
}

std::string escaped(const char* format, std::uint32_t code) {
  char buffer[12];
  std::snprintf(buffer, sizeof buffer, format, code);
  return buffer;
}

/// Between double quotes.
std::string escapedText(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const Character character = characterAt(text, i);
    if (character.bytes == 0) {
      result += escaped("\\x%02x", static_cast<unsigned char>(text[i++]));
      continue;
    }
    if (character.code == '\n') {
      result += "\\n";
    } else if (mustBeEscaped(character.code)) {
      result += escaped("\\u%04x", character.code);
    } else {
      if (character.code == '"' || character.code == '\\') result += '\\';
      result += text.substr(i, character.bytes);
    }
    i += character.bytes;
  }
  return result;
}

bool isPlain(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const Character character = characterAt(text, i);
    if (character.bytes == 0 || mustBeEscaped(character.code)) return false;
    i += character.bytes;
  }
  return true;
}

/// Of what escapedText() escapes: below U+10000.
std::string utf8Of(std::uint32_t code) {
  const auto byte = [](std::uint32_t value) { return std::string(1, static_cast<char>(value)); };
  if (code < 0x80) return byte(code);
  const std::string last = byte(0x80 | (code & 0x3f));
  if (code < 0x800) return byte(0xc0 | code >> 6) + last;
  return byte(0xe0 | code >> 12) + byte(0x80 | (code >> 6 & 0x3f)) + last;
}

/// What the escape at `line`[*position], behind the backslash, stands for.
std::string unescaped(const std::string& line, std::size_t* position) {
  const char kind = line[(*position)++];
  if (kind == 'n') return "\n";
  if (kind != 'x' && kind != 'u') return std::string(1, kind);
  const std::string digits = line.substr(*position, kind == 'x' ? 2 : 4);
  *position += digits.size();
  const auto code = static_cast<std::uint32_t>(std::strtoul(digits.c_str(), nullptr, 16));
  return kind == 'x' ? std::string(1, static_cast<char>(code)) : utf8Of(code);
}

}  // namespace

std::string yamlQuoted(const std::string& text) {
  if (!isPlain(text)) return '"' + escapedText(text) + '"';
  std::string result;
  for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c);
  return '\'' + result + '\'';
}

std::string yamlUnquoted(const std::string& line, std::size_t* position) {
  std::string text;
  if (*position >= line.size()) return text;
  const char quote = line[(*position)++];
  while (*position < line.size()) {
    const char c = line[(*position)++];
    if (c == quote) {
      const bool is_doubled = quote == '\'' && *position < line.size() && line[*position] == quote;
      if (!is_doubled) return text;
      ++*position;
    }
    const bool is_escape = quote == '"' && c == '\\' && *position < line.size();
    text += is_escape ? unescaped(line, position) : std::string(1, c);
  }
  return text;
}

}  // namespace sunlit
