#include "scene/robot/urdf_looks.h"

#include <tinyxml2.h>
#include <map>

#include <sdf/Link.hh>
#include <sdf/Material.hh>
#include <sdf/Model.hh>
#include <sdf/Root.hh>
#include <sdf/Visual.hh>

#include "scene/sdf_console.h"
#include "scene/sdf_library.h"
#include "scene/sdf_material.h"
#include "scene/sdf_mend.h"

namespace sunlit::scene {
namespace {

/// This <material> of `origin` as libsdformat reads it; null where it cannot.
sdf::ElementPtr parsed(const std::string& element, const std::string& origin, SceneBuilder& builder) {
  tinyxml2::XMLDocument document;
  document.Parse(("<sdf version='" SDF_PROTOCOL_VERSION
                  "'><model name='m'><link name='l'><visual name='v'><geometry><box><size>1 1 1</size></box>"
                  "</geometry>" +
                  element + "</visual></link></model></sdf>")
                     .c_str());
  if (document.RootElement() == nullptr) return nullptr;
  mendSdf(*document.RootElement(), origin, builder);
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  const SdfConsole console;  // what it prints would name no file
  sdf::Root root;
  root.LoadSdfString(printer.CStr());
  const sdf::Model* const model = modelOf(root);
  const sdf::Link* const link = model == nullptr ? nullptr : model->LinkByIndex(0);
  const sdf::Visual* const visual = link == nullptr ? nullptr : link->VisualByIndex(0);
  return visual == nullptr || visual->Material() == nullptr ? nullptr : visual->Material()->Element();
}

}  // namespace

class UrdfLooks::Reader {
 public:
  Reader(const std::string& origin, const ResourceFinder& finder, SceneBuilder& builder)
      : origin_(origin), builder_(builder), materials_(finder, builder) {}

  std::optional<int> add(const std::string& element, const std::string& place) {
    const auto [known, is_new] = known_.try_emplace(element);  // of all visuals of a link it is the same
    if (is_new) known->second = read(element, place);
    return known->second;
  }

  void put(int material, Mesh& mesh) const { materials_.put(material, mesh); }

 private:
  std::optional<int> read(const std::string& element, const std::string& place) {
    const sdf::ElementPtr found = parsed(element, origin_, builder_);
    if (!found) return std::nullopt;
    found->SetFilePath(origin_);
    sdf::Material material;
    if (!material.Load(found).empty()) return std::nullopt;
    return materials_.add(&material, place);
  }

  std::map<std::string, std::optional<int>> known_;
  std::string origin_;
  SceneBuilder& builder_;
  SdfMaterials materials_;
};

UrdfLooks::UrdfLooks(const std::string& origin, const ResourceFinder& finder, SceneBuilder& builder)
    : reader_(std::make_unique<Reader>(origin, finder, builder)), builder_(builder) {}

UrdfLooks::~UrdfLooks() = default;

std::optional<int> UrdfLooks::add(const std::string& element, const std::string& place) {
  const std::optional<int> material = reader_->add(element, place);
  if (!material) builder_.warn("materials of <gazebo> elements say nothing that can be read", place);
  return material;
}

void UrdfLooks::put(int material, Mesh& mesh) const {
  reader_->put(material, mesh);
}

}  // namespace sunlit::scene
