#include "scene/glb_file.h"

#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

namespace sunlit::scene {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinChunk = 0x004E4942;   // "BIN"

std::size_t paddedTo4(std::size_t size) {
  return (size + 3) / 4 * 4;
}

/// Little-endian, whatever the machine.
void appendWord(std::string& text, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) text += static_cast<char>((value >> shift) & 0xFF);
}

}  // namespace

std::size_t GlbBuffer::add(const void* data, std::size_t size) {
  const std::size_t offset = bytes_.size();
  bytes_.resize(offset + paddedTo4(size));
  std::memcpy(bytes_.data() + offset, data, size);
  views_.push_back("{\"buffer\":0,\"byteOffset\":" + std::to_string(offset) +
                   ",\"byteLength\":" + std::to_string(size) + "}");
  return views_.size() - 1;
}

std::string jsonString(const std::string& text) {
  using nlohmann::json;
  return json(text).dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string jsonArray(const std::vector<std::string>& items) {
  std::string text = "[";
  for (std::size_t i = 0; i < items.size(); ++i) text += (i == 0 ? "" : ",") + items[i];
  return text + "]";
}

std::string glbStart(std::string json, std::size_t size) {
  json.resize(paddedTo4(json.size()), ' ');
  const std::size_t total = 12 + 8 + json.size() + size;
  if (total > std::numeric_limits<std::uint32_t>::max()) {
    throw std::length_error("the scene is larger than the 4 GiB that binary glTF can hold");
  }
  std::string text;
  text.reserve(total);  // what follows, too
  for (const std::size_t word : {std::size_t{kMagic}, std::size_t{2}, total}) appendWord(text, word);
  appendWord(text, json.size());
  appendWord(text, kJsonChunk);
  text += json;
  return text;
}

std::string glbFile(std::string json, const GlbBuffer& buffer) {
  std::string text = glbStart(std::move(json), 8 + buffer.bytes().size());
  appendWord(text, buffer.bytes().size());
  appendWord(text, kBinChunk);
  text += buffer.bytes();
  return text;
}

}  // namespace sunlit::scene
