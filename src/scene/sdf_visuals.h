/// The visuals of SDF models as meshes.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <sdf/Geometry.hh>
#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/Visual.hh>
#include <sdf/World.hh>
#include <string>
#include <vector>

#include "scene/model_meshes.h"
#include "scene/sdf_files.h"
#include "scene/sdf_light.h"
#include "scene/sdf_material.h"
#include "scene/sdf_state.h"

namespace sunlit::scene {

class SdfVisuals {
 public:
  /// `file` is the SDF file that is loaded, for addresses in elements that do not know their own file.
  SdfVisuals(const std::string& file, const ResourceFinder& finder, SceneBuilder& builder)
      : file_(file),
        finder_(finder),
        builder_(builder),
        materials_(finder, builder),
        meshes_(finder, builder),
        bare_meshes_(finder, builder, false) {}

  /// What is added from now on stands where the state says.
  void standAs(const SdfState& state) { state_ = state; }

  /// Everything to see of the worlds, or the model, of `file` and of what they include.
  void addFile(const SdfFile& file);

  /// What the state had to say of models that were never added.
  const SdfState& state() const { return state_; }

  /// A light of what stands at `map_from_parent`, of that full name, where no state says otherwise.
  void addLight(const sdf::Light& light, const Eigen::Affine3d& map_from_parent, const LightName& name);

  /// The visuals and lights of one link at `map_from_link`; `name` is its full name.
  void addLink(const sdf::Link& link, const Eigen::Affine3d& map_from_link, const std::string& name);

 private:
  void addModel(const sdf::Model& model, const Eigen::Affine3d& map_from_parent, const std::string& scope);
  void addModelAt(const sdf::Model& model, const Eigen::Affine3d& map_from_file,
                  const std::string& full_name);
  void addIncluded(const SdfFile& file, const std::string& own_name);
  void addVisual(const sdf::Visual& visual, const Eigen::Affine3d& map_from_link, const std::string& scope);
  void addRoads(const sdf::World& world);
  int bareRoad();
  std::optional<Mesh> shapeOf(const sdf::Visual& visual, const std::string& name);
  void addMeshShape(const sdf::Visual& visual, const Eigen::Affine3d& map_from_visual,
                    const std::string& name, float opacity);

  std::string file_;
  SdfState state_;
  const ResourceFinder& finder_;
  SceneBuilder& builder_;
  SdfMaterials materials_;
  ModelMeshes meshes_;
  ModelMeshes bare_meshes_;  ///< of visuals with a material of their own
  std::optional<int> bare_road_;
  std::map<std::string, Eigen::Affine3d>
      map_from_models_;  ///< by full name, merged ones included, of those that are not deleted
};

}  // namespace sunlit::scene
