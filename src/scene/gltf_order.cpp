#include "scene/gltf_order.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "scene/gltf_json.h"

namespace sunlit::scene {
namespace {

using nlohmann::json;

/// What the scene that is shown wants first.
class Walk {
 public:
  explicit Walk(const json& root) : root_(root) {
    const json& scenes = child(root, "scenes");
    const auto number = indexOf(root, "scene", 0);
    if (!scenes.is_array() || number >= scenes.size()) return;
    for (const json& node : child(scenes.at(number), "nodes")) enter(indexOf(node));
  }
  const std::vector<std::size_t>& materials() const { return materials_; }

 private:
  void enter(std::size_t number) {
    const json& nodes = child(root_, "nodes");
    if (number >= nodes.size() || !nodes_.insert(number).second) return;
    const json& node = nodes.at(number);
    for (const json& below : child(node, "children")) enter(indexOf(below));
    if (node.contains("mesh")) look(indexOf(node.at("mesh")));
  }
  void look(std::size_t number) {
    const json& meshes = child(root_, "meshes");
    if (number >= meshes.size() || !meshes_.insert(number).second) return;
    for (const json& primitive : child(meshes.at(number), "primitives")) {
      if (!primitive.contains("material")) continue;
      const auto material = indexOf(primitive.at("material"));
      if (std::find(materials_.begin(), materials_.end(), material) == materials_.end())
        materials_.push_back(material);
    }
  }

  const json& root_;
  std::set<std::size_t> nodes_, meshes_;
  std::vector<std::size_t> materials_;
};

bool fits(const std::vector<std::size_t>& order, const json& materials,
          const std::vector<std::string>& names) {
  if (order.size() > names.size()) return false;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (order[i] >= materials.size()) return false;
    const std::string name = materials.at(order[i]).value("name", "");
    if (!name.empty() && name != names[i]) return false;
  }
  return true;
}

}  // namespace

std::vector<std::size_t> materialsInFile(const json& root, const std::string& file,
                                         const std::vector<std::string>& names) {
  const json& materials = child(root, "materials");
  std::vector<std::size_t> order;
  try {
    order = Walk(root).materials();
    if (!fits(order, materials, names)) {
      order.resize(std::min(names.size(), materials.size()));
      for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    }
  } catch (const std::exception& error) {
    throw std::runtime_error(file + ": its nodes, meshes and materials: " + error.what());
  }
  order.resize(names.size(), materials.size());
  return order;
}

}  // namespace sunlit::scene
