#include "scene/gltf_floats.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <set>
#include <stdexcept>

#include "scene/gltf_buffers.h"
#include "scene/gltf_json.h"

namespace sunlit::scene {
namespace {

using nlohmann::json;

constexpr std::size_t kFloat = 5126;

bool wantsFloats(const std::string& attribute) {
  for (const char* const kind : {"POSITION", "NORMAL", "TANGENT", "TEXCOORD_", "WEIGHTS_"})
    if (attribute.rfind(kind, 0) == 0) return true;
  return false;
}

/// Indices of the accessors of attributes that are floats elsewhere.
std::set<std::size_t> accessorsOfFloats(const json& root) {
  std::set<std::size_t> found;
  const auto note = [&found](const json& attributes) {
    if (!attributes.is_object()) return;
    for (const auto& [name, accessor] : attributes.items())
      if (wantsFloats(name) && accessor.is_number_unsigned()) found.insert(accessor.get<std::size_t>());
  };
  for (const json& mesh : child(root, "meshes")) {
    for (const json& primitive : child(mesh, "primitives")) {
      note(child(primitive, "attributes"));
      for (const json& target : child(primitive, "targets")) note(target);
    }
  }
  return found;
}

template <typename Whole>
float floatOf(const char* bytes, bool normalized) {
  Whole value;
  std::memcpy(&value, bytes, sizeof(value));
  const float number = static_cast<float>(value);
  return normalized ? std::max(number / static_cast<float>(std::numeric_limits<Whole>::max()), -1.0f)
                    : number;
}

/// A type of components; null in what is none of whole numbers.
struct Component {
  std::size_t bytes = 0;
  float (*read)(const char* bytes, bool normalized) = nullptr;
};
Component componentOf(std::size_t type) {
  switch (type) {
    case 5120:
      return {1, floatOf<std::int8_t>};
    case 5121:
      return {1, floatOf<std::uint8_t>};
    case 5122:
      return {2, floatOf<std::int16_t>};
    case 5123:
      return {2, floatOf<std::uint16_t>};
    default:
      return {};
  }
}

/// Appends the numbers of an accessor of whole ones to `floats`.
void appendFloats(const json& root, const json& accessor, GltfBuffers& buffers, std::string* floats) {
  const Component component = componentOf(indexOf(accessor, "componentType", kFloat));
  if (!child(accessor, "sparse").empty())
    throw std::runtime_error("sparse whole numbers are not read: export it without KHR_mesh_quantization");
  const json& view = child(root, "bufferViews").at(indexOf(accessor.at("bufferView")));
  const std::size_t numbers = numbersOfElement(accessor), size = numbers * component.bytes;
  const std::size_t stride = indexOf(view, "byteStride", size), count = indexOf(accessor.at("count"));
  const std::string& bytes = buffers.bytes(indexOf(view.at("buffer")));
  const std::size_t begin = indexOf(view, "byteOffset", 0) + indexOf(accessor, "byteOffset", 0);
  if (count == 0) return;
  if (begin > bytes.size() || stride == 0 || (bytes.size() - begin) / stride + 1 < count ||
      begin + (count - 1) * stride + size > bytes.size())
    throw std::runtime_error("an attribute reaches beyond its buffer");
  const bool normalized = accessor.value("normalized", false);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < numbers; ++k) {
      const float number =
          component.read(bytes.data() + begin + i * stride + k * component.bytes, normalized);
      floats->append(reinterpret_cast<const char*>(&number), sizeof(number));
    }
  }
}

}  // namespace

std::string useFloats(json& root, const std::string& file) {
  std::string floats;
  GltfBuffers buffers(root, file);
  std::size_t buffer = 0;
  try {
    const std::set<std::size_t> wanted = accessorsOfFloats(root);
    for (const std::size_t index : wanted) {
      if (index >= child(root, "accessors").size()) continue;  // Assimp says so
      json& accessor = root["accessors"][index];
      const bool whole = componentOf(indexOf(accessor, "componentType", kFloat)).read != nullptr;
      if (!whole || (!accessor.contains("bufferView") && !accessor.contains("sparse"))) continue;
      const std::size_t begin = floats.size();
      appendFloats(root, accessor, buffers, &floats);
      if (begin == floats.size()) continue;
      if (begin == 0) {
        buffer = root["buffers"].size();
        root["buffers"].push_back(json{{"uri", kFloats}});
      }
      accessor["bufferView"] = root["bufferViews"].size();
      root["bufferViews"].push_back(
          json{{"buffer", buffer}, {"byteOffset", begin}, {"byteLength", floats.size() - begin}});
      accessor["componentType"] = kFloat;
      for (const char* const key : {"byteOffset", "normalized", "min", "max"}) accessor.erase(key);
    }
  } catch (const json::exception& error) {
    throw std::runtime_error(file + ": an attribute is not as glTF has it: " + error.what());
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
  if (!floats.empty()) root["buffers"][buffer]["byteLength"] = floats.size();
  return floats;
}

}  // namespace sunlit::scene
