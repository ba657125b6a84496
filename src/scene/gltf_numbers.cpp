#include "scene/gltf_numbers.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

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

/// What stands in a view: `count` elements of `bytes` each.
struct Elements {
  std::size_t count, bytes;
};

/// The first of the elements that `from`, an accessor or a part of a sparse one, tells, and the bytes from
/// each to the next.
std::pair<const char*, std::size_t> found(const json& root, const json& from, const Elements& elements,
                                          GltfBuffers& buffers) {
  const json& view = child(root, "bufferViews").at(indexOf(from.at("bufferView")));
  const std::size_t stride = indexOf(view, "byteStride", elements.bytes);
  const std::string& bytes = buffers.bytes(indexOf(view.at("buffer")));
  const std::size_t begin = indexOf(view, "byteOffset", 0) + indexOf(from, "byteOffset", 0);
  if (elements.count == 0) return {nullptr, stride};
  if (begin > bytes.size() || stride == 0 || (bytes.size() - begin) / stride + 1 < elements.count ||
      begin + (elements.count - 1) * stride + elements.bytes > bytes.size())
    throw std::runtime_error("an attribute reaches beyond its buffer");
  return {bytes.data() + begin, stride};
}

/// Which elements a sparse accessor changes, each below `count`.
std::vector<std::size_t> changedBy(const json& root, const json& sparse, std::size_t count,
                                   GltfBuffers& buffers) {
  const json& told = sparse.at("indices");
  const std::size_t type = indexOf(told.at("componentType")), bytes = type == 5121 ? 1 : type == 5123 ? 2 : 4;
  const Elements elements{indexOf(sparse.at("count")), bytes};
  const auto [first, stride] = found(root, told, elements, buffers);
  std::vector<std::size_t> changed;
  for (std::size_t i = 0; i < elements.count; ++i) {
    std::size_t index = 0;
    for (std::size_t k = bytes; k-- > 0;)  // little-endian
      index = index << 8 | static_cast<std::uint8_t>(first[i * stride + k]);
    if (index >= count)
      throw std::runtime_error("a sparse attribute changes element " + std::to_string(index) + " of " +
                               std::to_string(count));
    changed.push_back(index);
  }
  return changed;
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
  const std::size_t numbers = numbersOfElement(accessor), count = indexOf(accessor.at("count"));
  const Elements elements{count, numbers * component.bytes};
  const bool normalized = accessor.value("normalized", false);
  const bool in_view = accessor.contains("bufferView");
  const auto [base, step] =
      in_view ? found(root, accessor, elements, buffers) : std::pair<const char*, std::size_t>();
  std::vector<float> floats(count * numbers, 0.0f);
  const auto read = [&](const char* from, std::size_t element) {
    for (std::size_t k = 0; k < numbers; ++k)
      floats[element * numbers + k] = component.read(from + k * component.bytes, normalized);
  };
  for (std::size_t i = 0; in_view && i < count; ++i) read(base + i * step, i);
  const json& sparse = child(accessor, "sparse");
  if (sparse.empty()) return floats;
  const std::vector<std::size_t> changed = changedBy(root, sparse, count, buffers);
  const auto [first, stride] = found(root, sparse.at("values"), {changed.size(), elements.bytes}, buffers);
  for (std::size_t i = 0; i < changed.size(); ++i) read(first + i * stride, changed[i]);
  return floats;
}

}  // namespace sunlit::scene
