#include "scene/gltf_json.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <utility>

#include "scene/uri_text.h"
#include "sunlit/quantity/utf8.h"

namespace sunlit::scene {

using nlohmann::json;

namespace {

constexpr const char* kPackings[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

}  // namespace

std::string bytesOf(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.is_open() || stream.bad()) throw std::runtime_error(file + ": cannot read this file");
  return bytes;
}

GltfParts gltfParts(const std::string& file) {
  std::string text = bytesOf(file);
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  if (text.compare(0, 4, "glTF") != 0 || text.size() < kHeader + kChunkHeader) {
    const std::size_t size = text.size();
    std::string plain = utf8Of(std::move(text), file);
    const bool marked = plain.size() < size;
    return {std::move(plain), "", false, marked};
  }
  std::size_t length = 0;
  for (std::size_t i = 0; i < 4; ++i)
    length |= static_cast<std::size_t>(static_cast<std::uint8_t>(text[kHeader + i])) << (8 * i);
  const std::size_t end = std::min(kHeader + kChunkHeader + length, text.size());
  return {text.substr(kHeader + kChunkHeader, length), text.substr(end), true};
}

json parseGltf(const std::string& text, const std::string& file) {
  try {
    json root = json::parse(text);
    if (!root.is_object()) throw std::runtime_error(file + ": its JSON is no object");
    return root;
  } catch (const json::exception& error) {
    throw std::runtime_error(file + ": cannot read its JSON: " + error.what());
  }
}

const json& child(const json& from, const char* key) {
  static const json none = json::object();
  const auto found = from.find(key);
  return found == from.end() ? none : *found;
}

std::size_t indexOf(const json& number) {
  if (number.is_number_unsigned()) return number.get<std::size_t>();
  throw std::runtime_error(number.dump(-1, ' ', false, json::error_handler_t::replace) +
                           " is no whole number of at least 0");
}

std::size_t indexOf(const json& from, const char* key, std::size_t usual) {
  const auto found = from.find(key);
  return found == from.end() ? usual : indexOf(*found);
}

std::size_t numbersOfElement(const json& accessor) {
  static const std::map<std::string, std::size_t> kNumbers = {{"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                                              {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
  const json& type = child(accessor, "type");
  const auto found = kNumbers.find(type.is_string() ? type.get<std::string>() : "");
  return found == kNumbers.end() ? 1 : found->second;
}

std::string meantPath(const std::string& path) {
  std::error_code error;
  const std::string plain = withoutEscapes(path);
  return std::filesystem::exists(path, error) || !std::filesystem::exists(plain, error) ? path : plain;
}

const json& extension(const json& from, const char* name) {
  return child(child(from, "extensions"), name);
}

bool isPacking(const std::string& name) {
  return std::find(std::begin(kPackings), std::end(kPackings), name) != std::end(kPackings);
}

const char* packingOf(const json& from) {
  for (const char* const name : kPackings) {
    if (!extension(from, name).empty()) return name;
  }
  return nullptr;
}

}  // namespace sunlit::scene
