#include "scene/gltf_draco.h"

#include <draco/compression/decode.h>
#include <draco/mesh/mesh.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "scene/gltf_json.h"
#include "scene/gltf_numbers.h"

namespace sunlit::scene {
namespace {

using nlohmann::json;

std::unique_ptr<draco::Mesh> meshOf(const json& view, GltfBuffers& buffers) {
  const std::string& bytes = buffers.bytes(indexOf(view.at("buffer")));
  const std::size_t begin = indexOf(view, "byteOffset", 0), length = indexOf(view.at("byteLength"));
  if (begin > bytes.size() || length > bytes.size() - begin)
    throw std::runtime_error("reaches beyond its buffer");
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data() + begin, length);
  auto mesh = draco::Decoder().DecodeMeshFromBuffer(&buffer);
  if (!mesh.ok()) throw std::runtime_error(std::string("cannot be unpacked: ") + mesh.status().error_msg());
  return std::move(mesh).value();
}

std::string cornersOf(const draco::Mesh& mesh) {
  std::string bytes;
  bytes.reserve(mesh.num_faces() * 3 * sizeof(std::uint32_t));
  for (std::uint32_t i = 0; i < mesh.num_faces(); ++i) {
    for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(i))) {
      const std::uint32_t number = corner.value();
      bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
    }
  }
  return bytes;
}

/// What stands of an attribute: `count` vertices of `numbers` components each.
struct Extent {
  std::size_t count, numbers;
};

template <typename Component>
std::string componentsOf(const draco::PointAttribute& attribute, const Extent& extent) {
  std::string bytes(extent.count * extent.numbers * sizeof(Component), '\0');
  auto* const to = reinterpret_cast<Component*>(bytes.data());
  for (std::uint32_t i = 0; i < extent.count; ++i) {
    if (!attribute.ConvertValue(attribute.mapped_index(draco::PointIndex(i)),
                                static_cast<std::int8_t>(extent.numbers), to + i * extent.numbers))
      throw std::runtime_error("an attribute is not of the type that the file tells");
  }
  return bytes;
}

/// As `accessor` tells them.
std::string valuesOf(const draco::PointAttribute& attribute, const Extent& extent, const json& accessor) {
  switch (indexOf(accessor.at("componentType"))) {
    case 5120:
      return componentsOf<std::int8_t>(attribute, extent);
    case 5121:
      return componentsOf<std::uint8_t>(attribute, extent);
    case 5122:
      return componentsOf<std::int16_t>(attribute, extent);
    case 5123:
      return componentsOf<std::uint16_t>(attribute, extent);
    case kFloatComponent:
      return componentsOf<float>(attribute, extent);
    default:
      throw std::runtime_error("an attribute is neither of floats nor of whole numbers of 8 or 16 bits");
  }
}

/// Unpacks one primitive after another into a buffer that will be the next of `root`.
class Unpacking {
 public:
  Unpacking(json& root, GltfBuffers& buffers)
      : root_(root), buffers_(buffers), buffer_(child(root, "buffers").size()) {}

  void unpack(json& primitive) {
    const json words = extension(primitive, kDraco);
    const auto mesh = meshOf(child(root_, "bufferViews").at(indexOf(words.at("bufferView"))), buffers_);
    for (const auto& [name, id] : words.at("attributes").items()) {
      const draco::PointAttribute* const attribute =
          mesh->GetAttributeByUniqueId(static_cast<std::uint32_t>(indexOf(id)));
      if (attribute == nullptr)
        throw std::runtime_error("there is no attribute " + id.dump() + " for " + name);
      json& index = primitive.at("attributes").at(name);
      index = addAttribute(*mesh, *attribute, child(root_, "accessors").at(indexOf(index)));
    }
    primitive["indices"] = addAccessor(json{{"componentType", kIndexComponent},
                                            {"count", std::size_t{3} * mesh->num_faces()},
                                            {"type", "SCALAR"}},
                                       cornersOf(*mesh));
    primitive["mode"] = kTriangles;
    primitive["extensions"].erase(kDraco);
  }

  std::string takeBytes() { return std::move(bytes_); }

 private:
  static constexpr std::size_t kIndexComponent = 5125, kTriangles = 4;

  std::size_t addAttribute(const draco::Mesh& mesh, const draco::PointAttribute& attribute, json accessor) {
    const Extent extent{indexOf(accessor.at("count")), numbersOfElement(accessor)};
    if (extent.count > mesh.num_points())
      throw std::runtime_error("has " + std::to_string(mesh.num_points()) +
                               " vertices, where the file tells " + std::to_string(extent.count));
    std::string values = valuesOf(attribute, extent, accessor);
    for (const char* const key : {"byteOffset", "sparse"}) accessor.erase(key);
    return addAccessor(std::move(accessor), std::move(values));
  }

  /// Its index.
  std::size_t addAccessor(json accessor, std::string values) {
    accessor["bufferView"] = root_["bufferViews"].size();
    root_["bufferViews"].push_back(
        json{{"buffer", buffer_}, {"byteOffset", bytes_.size()}, {"byteLength", values.size()}});
    bytes_ += values;
    bytes_.resize((bytes_.size() + 3) / 4 * 4);  // views begin at whole components
    root_["accessors"].push_back(std::move(accessor));
    return root_["accessors"].size() - 1;
  }

  json& root_;
  GltfBuffers& buffers_;
  std::size_t buffer_;
  std::string bytes_;
};

void takeName(json& root, const char* list) {
  json kept = json::array();
  for (const json& name : child(root, list))
    if (name != kDraco) kept.push_back(name);
  root[list] = std::move(kept);
}

}  // namespace

bool unpackDraco(json& root, GltfBuffers& buffers) {
  Unpacking unpacking(root, buffers);
  bool any = false;
  for (std::size_t i = 0; i < child(root, "meshes").size(); ++i) {
    json& mesh = root["meshes"].at(i);
    if (!child(mesh, "primitives").is_array()) continue;
    for (json& primitive : mesh["primitives"]) {
      if (extension(primitive, kDraco).empty()) continue;
      try {
        unpacking.unpack(primitive);
      } catch (const std::exception& error) {
        throw std::runtime_error(std::string(kDraco) + ": mesh " + std::to_string(i) + ": " + error.what());
      }
      any = true;
    }
  }
  if (!any) return false;
  buffers.add(unpacking.takeBytes());
  for (const char* const list : {"extensionsUsed", "extensionsRequired"}) takeName(root, list);
  return true;
}

}  // namespace sunlit::scene
