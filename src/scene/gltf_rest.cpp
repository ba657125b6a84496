#include "scene/gltf_rest.h"

#include <map>
#include <optional>
#include <stdexcept>

#include "scene/gltf_json.h"

namespace sunlit::scene {
namespace {

using nlohmann::json;

/// Whether a primitive of the mesh says by whole numbers how much of a bone is in a vertex.
bool hasWholeWeights(const json& root, const json& mesh) {
  constexpr std::size_t kFloat = 5126;
  for (const json& primitive : child(mesh, "primitives")) {
    const json& attributes = child(primitive, "attributes");
    if (!attributes.contains("WEIGHTS_0")) continue;
    const json& accessor = child(root, "accessors").at(indexOf(attributes.at("WEIGHTS_0")));
    if (indexOf(accessor, "componentType", kFloat) != kFloat) return true;
  }
  return false;
}

using Skin = std::optional<std::size_t>;

}  // namespace

std::vector<std::string> shapesNotRead(const json& root, const std::string& file) {
  std::vector<std::string> lost;
  std::map<std::size_t, Skin> skin_of_mesh;
  try {
    for (const json& node : child(root, "nodes")) {
      if (!node.contains("mesh")) continue;
      const std::string name = node.value("name", "one") + " of " + file;
      if (node.contains("weights"))
        lost.push_back(name + ": its own weights of morph targets, those of its mesh count");
      const auto mesh = indexOf(node.at("mesh"));
      const Skin skin = node.contains("skin") ? Skin(indexOf(node.at("skin"))) : std::nullopt;
      if (skin && hasWholeWeights(root, child(root, "meshes").at(mesh)))
        lost.push_back(name + ": weights of bones that are no floats");
      if (skin_of_mesh.emplace(mesh, skin).first->second != skin)
        lost.push_back(name + ": a skin of its own for a mesh that it shares");
    }
  } catch (const std::exception& error) {
    lost.push_back(file + ": " + error.what());
  }
  return lost;
}

}  // namespace sunlit::scene
