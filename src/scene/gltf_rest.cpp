#include "scene/gltf_rest.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "scene/gltf_json.h"

namespace sunlit::scene {
namespace {

using nlohmann::json;

using Skin = std::optional<std::size_t>;

/// Of an accessor.
std::uint64_t elementsOf(const json& root, const json& index) {
  return indexOf(child(root, "accessors").at(indexOf(index)).at("count"));
}

/// Attributes with a number for another number of vertices, which Assimp passes over.
void nameAttributes(const json& root, const std::string& file, std::vector<std::string>& lost) {
  std::size_t number = 0;
  for (const json& mesh : child(root, "meshes")) {
    const std::string name = mesh.value("name", "mesh " + std::to_string(number++)) + " of " + file;
    for (const json& primitive : child(mesh, "primitives")) {
      const json& attributes = child(primitive, "attributes");
      if (!attributes.contains("POSITION")) continue;
      const std::uint64_t vertices = elementsOf(root, attributes["POSITION"]);
      for (const auto& [attribute, accessor] : attributes.items()) {
        if (attribute[0] != '_' && elementsOf(root, accessor) != vertices)
          lost.push_back(name + ": its " + attribute + ", of which there are not as many as of its vertices");
      }
    }
  }
}

/// Of targets that are blended in: what is blended are places and normals.
void nameTargets(const json& root, const std::string& file, std::vector<std::string>& lost) {
  std::size_t number = 0;
  for (const json& mesh : child(root, "meshes")) {
    const std::string name = mesh.value("name", "mesh " + std::to_string(number++)) + " of " + file;
    const json& weights = child(mesh, "weights");
    const bool is_blended =
        std::any_of(weights.begin(), weights.end(), [](const json& weight) { return weight != 0; });
    std::set<std::string> others;
    for (const json& primitive : child(mesh, "primitives")) {
      for (const json& target : child(primitive, "targets")) {
        for (const auto& [attribute, accessor] : target.items()) {
          if (attribute.compare(0, 6, "COLOR_") == 0 || attribute.compare(0, 9, "TEXCOORD_") == 0)
            others.insert(attribute);
        }
      }
    }
    for (const std::string& other : others) {
      if (is_blended) lost.push_back(name + ": " + other + " of its morph targets");
    }
  }
}

/// Of a primitive, by its number of corners (glTF 2.0, section 3.7.2.1).
std::uint64_t trianglesOf(const json& root, const json& primitive) {
  const std::size_t mode = indexOf(primitive, "mode", 4);
  const json& attributes = child(primitive, "attributes");
  if (mode < 4 || !attributes.contains("POSITION")) return 0;
  const std::uint64_t corners =
      elementsOf(root, primitive.contains("indices") ? primitive["indices"] : attributes["POSITION"]);
  return mode == 4 ? corners / 3 : corners < 2 ? 0 : corners - 2;
}

}  // namespace

bool usesDraco(const json& root) {
  for (const json& mesh : child(root, "meshes")) {
    for (const json& primitive : child(mesh, "primitives"))
      if (!extension(primitive, kDraco).empty()) return true;
  }
  return false;
}

std::uint64_t trianglesOfScene(const json& root) {
  const json& scenes = child(root, "scenes");
  const std::size_t scene = indexOf(root, "scene", 0);
  if (scene >= scenes.size()) return 0;
  const json &nodes = child(root, "nodes"), &meshes = child(root, "meshes");
  std::vector<std::size_t> open;
  for (const json& node : child(scenes[scene], "nodes")) open.push_back(indexOf(node));
  std::set<std::size_t> shown;
  while (!open.empty()) {
    const json& node = nodes.at(open.back());
    open.pop_back();
    for (const json& below : child(node, "children")) open.push_back(indexOf(below));
    if (node.contains("mesh")) shown.insert(indexOf(node["mesh"]));
  }
  std::uint64_t triangles = 0;
  for (const std::size_t mesh : shown) {
    for (const json& primitive : child(meshes.at(mesh), "primitives"))
      triangles += trianglesOf(root, primitive);
  }
  return triangles;
}

std::vector<std::string> scenesNotShown(const json& root, const std::string& file) {
  std::vector<std::string> lost;
  const json& scenes = child(root, "scenes");
  const std::size_t shown = indexOf(root, "scene", 0);
  for (std::size_t i = 0; scenes.is_array() && i < scenes.size(); ++i) {
    const json& name = child(scenes[i], "name");
    if (i != shown)
      lost.push_back((name.is_string() ? name.get<std::string>() : "scene " + std::to_string(i)) + " of " +
                     file);
  }
  return lost;
}

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
    nameAttributes(root, file, lost);
    nameTargets(root, file, lost);
  } catch (const std::exception& error) {
    lost.push_back(file + ": " + error.what());
  }
  return lost;
}

}  // namespace sunlit::scene
