#include "scene/gltf_buffers.h"

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "scene/gltf_json.h"
#include "sunlit/image/files.h"

namespace sunlit::scene {
namespace {

/// Of the base64 alphabet (RFC 4648, section 4); −1 for any other letter.
int valueOf(char letter) {
  if (letter >= 'A' && letter <= 'Z') return letter - 'A';
  if (letter >= 'a' && letter <= 'z') return letter - 'a' + 26;
  if (letter >= '0' && letter <= '9') return letter - '0' + 52;
  return letter == '+' ? 62 : letter == '/' ? 63 : -1;
}

/// Up to the first letter that is none of the alphabet's, such as the padding.
std::string decodedBase64(const std::string& text, std::size_t begin) {
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (std::size_t i = begin; i < text.size() && valueOf(text[i]) >= 0; ++i) {
    bits = bits << 6 | static_cast<std::uint32_t>(valueOf(text[i]));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFF);
  }
  return bytes;
}

/// The content of the second chunk of a .glb.
std::string secondChunk(const std::string& file) {
  constexpr std::size_t kChunkHeader = 8;
  const std::string rest = gltfParts(file).rest;
  if (rest.size() < kChunkHeader)
    throw std::runtime_error("a buffer has no address, and the file no bytes of its own");
  return rest.substr(kChunkHeader);
}

bool isInline(const std::string& uri) {
  return uri.compare(0, 5, "data:") == 0;
}

std::string addressOf(std::size_t made) {
  return "sunlit_made_" + std::to_string(made) + ".bin";
}

}  // namespace

const std::string& GltfBuffers::bytes(std::size_t buffer) {
  if (const auto made = made_.find(buffer); made != made_.end()) return made->second;
  const auto known = read_.find(buffer);
  return known != read_.end() ? known->second : read_[buffer] = read(buffer);
}

std::size_t GltfBuffers::add(std::string bytes) {
  const std::size_t buffer = root_["buffers"].size();
  root_["buffers"].push_back(nlohmann::json::object());
  make(buffer, std::move(bytes));
  return buffer;
}

void GltfBuffers::make(std::size_t buffer, std::string bytes) {
  root_["buffers"][buffer]["uri"] = addressOf(buffer);
  root_["buffers"][buffer]["byteLength"] = bytes.size();
  made_[buffer] = std::move(bytes);
}

std::map<std::string, std::string> GltfBuffers::takeMade() {
  std::map<std::string, std::string> by_address;
  for (auto& [buffer, bytes] : made_) by_address[addressOf(buffer)] = std::move(bytes);
  made_.clear();
  return by_address;
}

std::string GltfBuffers::read(std::size_t buffer) const {
  const nlohmann::json& list = child(root_, "buffers");
  if (!list.is_array() || buffer >= list.size())
    throw std::runtime_error("there is no buffer " + std::to_string(buffer));
  const nlohmann::json& address = child(list[buffer], "uri");
  const char* const packing = packingOf(list[buffer]);
  if (!address.is_string() && packing != nullptr)
    throw std::runtime_error(std::string(packing) + ": buffer " + std::to_string(buffer) +
                             " is nowhere but in packed views, which were not unpacked");
  if (!address.is_string() && buffer > 0)
    throw std::runtime_error("buffer " + std::to_string(buffer) + " has no address");
  if (!address.is_string()) return secondChunk(file_);
  const std::string uri = address.get<std::string>();
  if (isInline(uri)) {
    const std::size_t comma = uri.find(',');
    return comma == std::string::npos ? "" : decodedBase64(uri, comma + 1);
  }
  return bytesOf(pathOf(uri));
}

std::string GltfBuffers::pathOf(const std::string& uri) const {
  return meantPath((std::filesystem::path(file_).parent_path() / uri).string());
}

void GltfBuffers::requireContents() const {
  const nlohmann::json& list = child(root_, "buffers");
  if (!list.is_array()) return;
  for (const nlohmann::json& buffer : list) {
    const nlohmann::json& address = child(buffer, "uri");
    if (!address.is_string()) continue;
    const auto& uri = address.get_ref<const std::string&>();
    if (!isInline(uri)) image::requireContent(pathOf(uri));
  }
}

}  // namespace sunlit::scene
