#include "scene/collada_instances.h"

#include <map>
#include <set>

#include "scene/collada_tags.h"
#include "scene/sdf_xml.h"

namespace sunlit::scene {
namespace {

using tinyxml2::XMLElement;
using ElementsById = std::map<std::string, XMLElement*>;

/// What stands in the libraries of this name.
ElementsById entriesOf(XMLElement& root, const char* libraries) {
  ElementsById entries;
  for (XMLElement* library : childrenOf(root, libraries)) {
    for (XMLElement* entry : childrenOf(*library)) entries.emplace(attributeOf(*entry, "id"), entry);
  }
  return entries;
}

/// By an address of this file; null where there is none, as by those of other files.
XMLElement* entryAt(const std::string& address, const ElementsById& entries) {
  if (address.compare(0, 1, "#") != 0) return nullptr;
  const auto found = entries.find(withoutHash(address));
  return found == entries.end() ? nullptr : found->second;
}

class ShownInstances {
 public:
  ShownInstances(XMLElement& root, const std::string& file, SceneBuilder& builder)
      : file_(file),
        builder_(builder),
        geometries_(entriesOf(root, "library_geometries")),
        controllers_(entriesOf(root, "library_controllers")),
        lights_(entriesOf(root, "library_lights")),
        nodes_(entriesOf(root, "library_nodes")),
        scenes_(entriesOf(root, "library_visual_scenes")) {}

  void checkScene(const std::string& address) {
    XMLElement* const scene = entryAt(address, scenes_);
    if (scene == nullptr) return;  // Assimp says so
    nodes_.insert(scenes_.begin(), scenes_.end());
    forEachBelow(*scene, [&](XMLElement& node) {
      if (std::string(node.Value()) != "node") return;
      for (const char* called : {"id", "name"}) nodes_.emplace(attributeOf(node, called), &node);
    });
    checkNode(*scene);
  }

 private:
  void checkNode(XMLElement& node) {
    if (!checked_.insert(&node).second) return;
    for (XMLElement* child : childrenOf(node)) {
      const std::string kind = child->Value(), address = attributeOf(*child, "url");
      XMLElement* const shown = kind == "node" ? child : entryAt(address, nodes_);
      if (kind == "instance_geometry" || kind == "instance_controller")
        checkShape(*child);
      else if (kind == "instance_light" && entryAt(address, lights_) == nullptr)
        nameLost(*child);
      else if (kind == "instance_node" && shown == nullptr)
        nameLost(*child);
      else if (kind == "instance_node" || kind == "node")
        checkNode(*shown);
    }
  }

  /// By way of the skin that it may have.
  void checkShape(const XMLElement& instance) {
    std::string address = attributeOf(instance, "url");
    XMLElement* const controller = entryAt(address, controllers_);
    if (controller != nullptr && controller->FirstChildElement("skin") != nullptr)
      address = attributeOf(*controller->FirstChildElement("skin"), "source");
    const XMLElement* const geometry = entryAt(address, geometries_);
    if (geometry == nullptr) return nameLost(instance);
    if (geometry->FirstChildElement("mesh") != nullptr || !named_.insert(geometry).second) return;
    for (const char* kind : {"convex_mesh", "spline", "brep"}) {
      if (geometry->FirstChildElement(kind) != nullptr)
        builder_.warn("geometries are no <mesh>, and were left out", "<" + std::string(kind) + "> " +
                                                                         attributeOf(*geometry, "id") +
                                                                         " of " + placeOf(file_, *geometry));
    }
  }

  void nameLost(const XMLElement& instance) {
    builder_.warn("instances refer to nothing that is read from their file, and were left out",
                  "<" + std::string(instance.Value()) + "> " + attributeOf(instance, "url") + " of " +
                      placeOf(file_, instance));
  }

  const std::string& file_;
  SceneBuilder& builder_;
  const ElementsById geometries_, controllers_, lights_;
  ElementsById nodes_;  ///< also of the scene, by name, too, where no library has them
  const ElementsById scenes_;
  std::set<const XMLElement*> checked_, named_;
};

}  // namespace

void warnOfLostInstances(XMLElement& root, const std::string& file, SceneBuilder& builder) {
  ShownInstances instances(root, file, builder);
  for (XMLElement* scene : childrenOf(root, "scene")) {
    for (const XMLElement* shown : childrenOf(*scene, "instance_visual_scene"))
      instances.checkScene(attributeOf(*shown, "url"));
  }
}

std::string withInstancesWithin(const std::string& text) {
  TextChanges changes;
  forEachTag(text, [&](const std::string& name, const std::string& tag, std::size_t at) {
    if (name != "instance_geometry" && name != "instance_controller" && name != "instance_light" &&
        name != "instance_camera")
      return;
    const std::size_t begin = placeInTag(tag, "url").first;
    if (begin == std::string::npos)
      changes[at + 1 + name.size()] = {0, " url=\"#\""};
    else if (tag[begin] != '#')
      changes[at + begin] = {0, "#"};
  });
  return changed(text, changes);
}

}  // namespace sunlit::scene
