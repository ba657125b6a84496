#include "scene/gltf_numbers.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "scene/gltf_json.h"

namespace sunlit::scene {
namespace {

using nlohmann::json;

template <typename Component>
float floatOf(const char* bytes, bool normalized) {
  Component value;
  std::memcpy(&value, bytes, sizeof(value));
  const auto number = static_cast<float>(value);
  if (std::is_floating_point_v<Component> || !normalized) return number;
  return std::max(number / static_cast<float>(std::numeric_limits<Component>::max()), -1.0f);
}

/// A type of components; null for others than those of floats and of small whole numbers.
struct Component {
  std::size_t bytes = 0;
  float (*read)(const char* bytes, bool normalized) = nullptr;
};
Component componentOf(const json& accessor) {
  switch (indexOf(accessor, "componentType", kFloatComponent)) {
    case 5120:
      return {1, floatOf<std::int8_t>};
    case 5121:
      return {1, floatOf<std::uint8_t>};
    case 5122:
      return {2, floatOf<std::int16_t>};
    case 5123:
      return {2, floatOf<std::uint16_t>};
    case kFloatComponent:
      return {4, floatOf<float>};
    default:
      return {};
  }
}

}  // namespace

bool tellsWholeNumbers(const json& accessor) {
  const Component component = componentOf(accessor);
  return component.read != nullptr && component.bytes < sizeof(float);
}

std::vector<float> floatsOf(const json& root, const json& accessor, GltfBuffers& buffers) {
  const Component component = componentOf(accessor);
  if (component.read == nullptr)
    throw std::runtime_error("an attribute is neither of floats nor of whole numbers of 8 or 16 bits");
  if (!child(accessor, "sparse").empty())
    throw std::runtime_error("sparse whole numbers are not read: export it without KHR_mesh_quantization");
  const json& view = child(root, "bufferViews").at(indexOf(accessor.at("bufferView")));
  const std::size_t numbers = numbersOfElement(accessor), size = numbers * component.bytes;
  const std::size_t stride = indexOf(view, "byteStride", size), count = indexOf(accessor.at("count"));
  const std::string& bytes = buffers.bytes(indexOf(view.at("buffer")));
  const std::size_t begin = indexOf(view, "byteOffset", 0) + indexOf(accessor, "byteOffset", 0);
  std::vector<float> floats;
  if (count == 0) return floats;
  if (begin > bytes.size() || stride == 0 || (bytes.size() - begin) / stride + 1 < count ||
      begin + (count - 1) * stride + size > bytes.size())
    throw std::runtime_error("an attribute reaches beyond its buffer");
  const bool normalized = accessor.value("normalized", false);
  floats.reserve(count * numbers);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < numbers; ++k)
      floats.push_back(component.read(bytes.data() + begin + i * stride + k * component.bytes, normalized));
  }
  return floats;
}

}  // namespace sunlit::scene
