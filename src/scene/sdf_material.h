/// The materials of SDF visuals.
#pragma once

#include <map>
#include <optional>
#include <sdf/Material.hh>
#include <sdf/Pbr.hh>
#include <string>

#include "scene/resource_finder.h"
#include "scene/scene_builder.h"

namespace sunlit::scene {

/// Turns <material> elements into ours, each different one once.
class SdfMaterials {
 public:
  SdfMaterials(const ResourceFinder& finder, SceneBuilder& builder) : finder_(finder), builder_(builder) {}

  /// Index of the material in the builder. None if `source` is null or says nothing about the look (a bare
  /// shader, say): a mesh then keeps its own.
  std::optional<int> add(const sdf::Material* source);

  /// What a shape without any material gets.
  int neutral();

 private:
  Material fromScript(const sdf::Material& source);
  void readPbr(const sdf::Material& source, Material& material);
  void readMaps(const sdf::PbrWorkflow& metal, const sdf::Material& source, Material& material);
  int texture(const std::string& name, const std::string& from_file);

  const ResourceFinder& finder_;
  SceneBuilder& builder_;
  std::map<std::string, int> index_by_content_;
};

}  // namespace sunlit::scene
