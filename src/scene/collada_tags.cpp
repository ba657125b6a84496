#include "scene/collada_tags.h"

#include <algorithm>

namespace sunlit::scene {

void forEachTag(
    const std::string& text,
    const std::function<void(const std::string& name, const std::string& tag, std::size_t at)>& use) {
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
    const bool is_comment = text.compare(at, 4, "<!--") == 0;
    const std::size_t end = text.find(is_comment ? "-->" : ">", at);
    if (end == std::string::npos) return;
    if (!is_comment && text[at + 1] != '/') {
      const std::string tag = text.substr(at, end + 1 - at);
      use(tag.substr(1, tag.find_first_of(" \t\r\n/>", 1) - 1), tag, at);
    }
    at = end;
  }
}

std::pair<std::size_t, std::size_t> placeInTag(const std::string& tag, const std::string& attribute) {
  const std::string blanks = " \t\r\n";
  for (std::size_t at = tag.find(attribute, 1); at != std::string::npos; at = tag.find(attribute, at + 1)) {
    const std::size_t equals = tag.find_first_not_of(blanks, at + attribute.size());
    if (blanks.find(tag[at - 1]) == std::string::npos || equals == std::string::npos || tag[equals] != '=')
      continue;
    const std::size_t quote = tag.find_first_of("\"'", equals);
    const std::size_t end = quote == std::string::npos ? quote : tag.find(tag[quote], quote + 1);
    if (end != std::string::npos) return {quote + 1, end - quote - 1};
  }
  return {std::string::npos, 0};
}

std::string changed(const std::string& text, const TextChanges& changes) {
  std::string whole;
  std::size_t copied = 0;
  for (const auto& [at, change] : changes) {
    if (at < copied) continue;
    whole.append(text, copied, at - copied).append(change.second);
    copied = at + change.first;
  }
  return whole.append(text, copied, std::string::npos);
}

std::string contentBehind(std::size_t at, const std::string& text) {
  return text.substr(at, std::min(text.find('<', at), text.size()) - at);
}

std::string withoutHash(const std::string& address) {
  return address.compare(0, 1, "#") == 0 ? address.substr(1) : address;
}

std::string valueInTag(const std::string& tag, const std::string& attribute) {
  const auto [begin, length] = placeInTag(tag, attribute);
  return begin == std::string::npos ? "" : tag.substr(begin, length);
}

}  // namespace sunlit::scene
