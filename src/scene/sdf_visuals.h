/// The visuals of SDF models as meshes.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <sdf/Geometry.hh>
#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/Visual.hh>
#include <string>
#include <vector>

#include "scene/mesh_file.h"
#include "scene/sdf_material.h"
#include "scene/sdf_state.h"

namespace sunlit::scene {

class SdfVisuals {
 public:
  /// `file` is the SDF file that is loaded, for addresses in elements that do not know their own file.
  SdfVisuals(const std::string& file, const ResourceFinder& finder, SceneBuilder& builder)
      : file_(file), finder_(finder), builder_(builder), materials_(finder, builder) {}

  /// What is added from now on stands where the state says; `state` must outlive this.
  void standAs(const SdfState& state) { state_ = &state; }

  /// Everything to see of `model`, whose parent frame stands at `map_from_parent`. `scope` names what it is
  /// in.
  void addModel(const sdf::Model& model, const Eigen::Isometry3d& map_from_parent, const std::string& scope);

  /// The same with the model's own frame at `map_from_model`, where no state says otherwise, and another full
  /// name.
  void addModelAt(const sdf::Model& model, const Eigen::Isometry3d& map_from_model, const std::string& name);

  /// The visuals of one link at `map_from_link`; `name` is its full name.
  void addLink(const sdf::Link& link, const Eigen::Isometry3d& map_from_link, const std::string& name);

 private:
  void addVisual(const sdf::Visual& visual, const Eigen::Isometry3d& map_from_link, const std::string& scope);
  void addMeshShape(const sdf::Visual& visual, const Eigen::Isometry3d& map_from_visual,
                    const std::string& name);
  const std::vector<MeshPart>& partsOf(const sdf::Mesh& mesh, const std::string& name);

  Eigen::Isometry3d placed(const std::string& name, const Eigen::Isometry3d& map_from_own) const;

  std::string file_;
  const SdfState* state_ = nullptr;
  const ResourceFinder& finder_;
  SceneBuilder& builder_;
  SdfMaterials materials_;
  std::map<std::string, std::vector<MeshPart>> parts_by_file_;
};

}  // namespace sunlit::scene
