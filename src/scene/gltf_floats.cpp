#include "scene/gltf_floats.h"

#include <set>
#include <string>
#include <vector>

#include "scene/gltf_json.h"
#include "scene/gltf_numbers.h"

namespace sunlit::scene {
namespace {

using nlohmann::json;

bool wantsFloats(const std::string& attribute) {
  for (const char* const kind : {"POSITION", "NORMAL", "TANGENT", "TEXCOORD_", "WEIGHTS_", "COLOR_"})
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

}  // namespace

bool useFloats(json& root, GltfBuffers& buffers) {
  std::string all;
  const std::size_t buffer = child(root, "buffers").size();  // that will be theirs
  for (const std::size_t index : accessorsOfFloats(root)) {
    if (index >= child(root, "accessors").size()) continue;  // Assimp says so
    json& accessor = root["accessors"][index];
    if (!tellsWholeNumbers(accessor) || (!accessor.contains("bufferView") && !accessor.contains("sparse")))
      continue;
    const std::vector<float> floats = floatsOf(root, accessor, buffers);
    if (floats.empty()) continue;
    const std::size_t bytes = sizeof(float) * floats.size();
    accessor["bufferView"] = root["bufferViews"].size();
    root["bufferViews"].push_back(
        json{{"buffer", buffer}, {"byteOffset", all.size()}, {"byteLength", bytes}});
    accessor["componentType"] = kFloatComponent;
    for (const char* const key : {"byteOffset", "normalized", "sparse", "min", "max"}) accessor.erase(key);
    all.append(reinterpret_cast<const char*>(floats.data()), bytes);
  }
  if (all.empty()) return false;
  buffers.add(std::move(all));
  return true;
}

}  // namespace sunlit::scene
