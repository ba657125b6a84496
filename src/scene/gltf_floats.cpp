#include "scene/gltf_floats.h"

#include <map>
#include <string>
#include <vector>

#include "scene/gltf_json.h"
#include "scene/gltf_numbers.h"

namespace sunlit::scene {
namespace {

using nlohmann::json;

bool begins(const std::string& attribute, const char* kind) {
  return attribute.rfind(kind, 0) == 0;
}

bool wantsFloats(const std::string& attribute) {
  for (const char* const kind : {"POSITION", "NORMAL", "TANGENT", "TEXCOORD_", "WEIGHTS_", "COLOR_"})
    if (begins(attribute, kind)) return true;
  return false;
}

/// Indices of the accessors of attributes that are floats elsewhere, and whether they are colours.
std::map<std::size_t, bool> accessorsOfFloats(const json& root) {
  std::map<std::size_t, bool> found;
  const auto note = [&found](const json& attributes) {
    if (!attributes.is_object()) return;
    for (const auto& [name, accessor] : attributes.items())
      if (wantsFloats(name) && accessor.is_number_unsigned())
        found[accessor.get<std::size_t>()] |= begins(name, "COLOR_");
  };
  for (const json& mesh : child(root, "meshes")) {
    for (const json& primitive : child(mesh, "primitives")) {
      note(child(primitive, "attributes"));
      for (const json& target : child(primitive, "targets")) note(target);
    }
  }
  return found;
}

/// Whole numbers; and floats of a sparse accessor, whose views Assimp 5.2 takes for without gaps.
bool wantsMaking(const json& accessor) {
  if (accessor.contains("sparse"))
    return tellsWholeNumbers(accessor) || indexOf(accessor, "componentType", 0) == kFloatComponent;
  return tellsWholeNumbers(accessor) && accessor.contains("bufferView");
}

}  // namespace

bool useFloats(json& root, GltfBuffers& buffers) {
  std::string all;
  const std::size_t buffer = child(root, "buffers").size();  // that will be theirs
  for (const auto& [index, is_color] : accessorsOfFloats(root)) {
    if (index >= child(root, "accessors").size()) continue;  // Assimp says so
    json& accessor = root["accessors"][index];
    if (!wantsMaking(accessor)) continue;
    // No colour is meant as 255 whole ones, though files may forget to say so; other readers divide all.
    if (is_color) accessor["normalized"] = true;
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
