#include "scene/gltf_rest.h"

#include <map>
#include <optional>
#include <stdexcept>

#include "scene/gltf_json.h"

namespace sunlit::scene {
namespace {

using nlohmann::json;

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
      if (skin_of_mesh.emplace(mesh, skin).first->second != skin)
        lost.push_back(name + ": a skin of its own for a mesh that it shares");
    }
  } catch (const std::exception& error) {
    lost.push_back(file + ": " + error.what());
  }
  return lost;
}

}  // namespace sunlit::scene
