#include "scene/gltf_addresses.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "scene/gltf_json.h"
#include "scene/uri_text.h"

namespace sunlit::scene {
namespace {

using nlohmann::json;

/// RFC 4648, with padding.
std::string base64Of(const std::string& bytes) {
  static const char* const letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (k < count ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? letters[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

/// Whether it was another.
bool makePlain(std::string& address) {
  const std::string scheme = "data:", encoding = ";base64";
  const std::size_t comma = address.find(',');
  if (comma == std::string::npos || lowerCase(address.substr(0, scheme.size())) != scheme) return false;
  const std::string type = lowerCase(address.substr(scheme.size(), comma - scheme.size()));
  const bool encoded = type.size() >= encoding.size() &&
                       type.compare(type.size() - encoding.size(), encoding.size(), encoding) == 0;
  const bool has_escapes = address.find('%', comma) != std::string::npos;
  if (encoded && !has_escapes && address.compare(0, comma, scheme + type) == 0) return false;
  const std::string data = withoutEscapes(address.substr(comma + 1));
  address = scheme + type + (encoded ? "," + data : encoding + "," + base64Of(data));
  return true;
}

}  // namespace

bool usePlainAddresses(json& root) {
  bool any = false;
  for (const char* const list : {"buffers", "images"}) {
    if (!child(root, list).is_array()) continue;
    for (json& one : root[list]) {
      if (child(one, "uri").is_string()) any |= makePlain(one["uri"].get_ref<std::string&>());
    }
  }
  return any;
}

}  // namespace sunlit::scene
