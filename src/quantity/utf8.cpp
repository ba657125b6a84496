#include "sunlit/quantity/utf8.h"

#include <stdexcept>

namespace sunlit {
namespace {

/// By its mark, or by the zeros beside letters, of which UTF-8 has none.
bool isWide(const std::string& text) {
  if (text.size() < 2) return false;
  const std::string first = text.substr(0, 2);
  return first == "\xFF\xFE" || first == "\xFE\xFF" || first.find('\0') != std::string::npos;
}

}  // namespace

std::string utf8Of(std::string text, const std::string& file) {
  if (isWide(text)) throw std::runtime_error(file + ": this is text in UTF-16 or UTF-32: save it as UTF-8");
  const std::string mark = "\xEF\xBB\xBF";
  if (text.compare(0, mark.size(), mark) == 0) text.erase(0, mark.size());
  return text;
}

}  // namespace sunlit
