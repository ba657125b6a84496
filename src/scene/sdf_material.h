/// The materials of SDF visuals.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <sdf/Material.hh>
#include <sdf/Pbr.hh>
#include <string>

#include "scene/gazebo_material.h"
#include "scene/resource_finder.h"
#include "scene/scene_builder.h"
#include "scene/sdf_script.h"

namespace sunlit::scene {

/// Turns <material> elements into ours, each different one once.
class SdfMaterials {
 public:
  SdfMaterials(const ResourceFinder& finder, SceneBuilder& builder)
      : finder_(finder), builder_(builder), scripts_(finder, builder) {}

  /// Whether `source` is there and says anything about the look: add() gives a material then.
  static bool isLook(const sdf::Material* source);
  /// Index of the material in the builder. None unless isLook() (of a bare shader, say): a mesh then keeps
  /// its own. It has the name of its script, else of its first `user`.
  std::optional<int> add(const sdf::Material* source, const std::string& user);

  /// Gives `mesh` a material of add(), with its texture as large as the script says.
  void put(int material, Mesh& mesh) const;

  /// What a shape without any material gets.
  int neutral();

 private:
  struct Scripted {
    Material material;
    Eigen::Array2f texture_scale{1.0f, 1.0f};  ///< ScriptMaterial::texture_scale
  };
  Scripted fromScript(const sdf::Material& source);
  Material lookOf(const ScriptMaterial& script, const ScriptUse& use);
  void readPbr(const sdf::Material& source, Material& material);
  void readOpacity(float alpha, Material* material);
  void nameLost(const sdf::Material& source, const std::string& name);
  void readMaps(const sdf::PbrWorkflow& metal, const sdf::Material& source, Material& material);
  int texture(const std::string& name, const std::string& from_file);

  const ResourceFinder& finder_;
  SceneBuilder& builder_;
  MaterialScripts scripts_;
  std::map<std::string, int> index_by_content_;
  std::map<int, Eigen::Array2f> texture_scales_;  ///< of materials, where it is not 1
};

}  // namespace sunlit::scene
