#include "scene/uri_text.h"

#include <algorithm>
#include <cctype>

namespace sunlit::scene {

std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

std::string withoutScheme(const std::string& uri) {
  // RFC 8089: of this machine, which may be named, and need not be with a single slash.
  const std::string local = "file://localhost/", short_form = "file:/";
  if (uri.rfind(local, 0) == 0) return uri.substr(local.size() - 1);
  const std::size_t end = uri.find("://");
  if (end != std::string::npos) return uri.substr(end + 3);
  return uri.rfind(short_form, 0) == 0 ? uri.substr(short_form.size() - 1) : uri;
}

std::string withoutEscapes(const std::string& text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool escape = text[i] == '%' && i + 2 < text.size() &&
                        std::isxdigit(static_cast<unsigned char>(text[i + 1])) &&
                        std::isxdigit(static_cast<unsigned char>(text[i + 2]));
    if (!escape) {
      plain += text[i];
      continue;
    }
    plain += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
    i += 2;
  }
  return plain;
}

}  // namespace sunlit::scene
