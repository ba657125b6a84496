/// The visuals of URDF links as meshes.
#pragma once

#include <urdf_model/link.h>

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/model_meshes.h"
#include "scene/resource_finder.h"
#include "scene/robot/urdf_gazebo.h"
#include "scene/robot/urdf_looks.h"
#include "scene/scene_builder.h"
#include "scene/sdf_script.h"

namespace sunlit::scene {

inline Eigen::Isometry3d toEigen(const urdf::Pose& pose) {
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.translate(Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z));
  transform.rotate(
      Eigen::Quaterniond(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z).normalized());
  return transform;
}

class UrdfVisuals {
 public:
  /// `origin` is the file of the text, or what stands for it.
  UrdfVisuals(const std::string& origin, const ResourceFinder& finder, SceneBuilder& builder)
      : origin_(origin),
        finder_(finder),
        builder_(builder),
        meshes_(finder, builder),
        looks_(origin, finder, builder),
        scripts_(finder, builder) {}

  /// Adds everything to see of `link`, in its frame. `place` names the link in messages. Visuals without a
  /// material of theirs have what `of_gazebo` says, if anything.
  void add(const urdf::Link& link, const std::string& place, const GazeboMaterial& of_gazebo);

 private:
  void addVisual(const urdf::Visual& visual, const std::string& name, const std::string& place);
  struct MeshUse {
    std::optional<int> own_material;  ///< of the URDF, if it names one
    bool is_of_gazebo;                ///< that
    float opacity;                    ///< of that
    Eigen::Isometry3d link_from_visual;
  };
  void addMeshShape(const urdf::Mesh& shape, const MeshUse& use, const std::string& name,
                    const std::string& place);
  std::optional<int> material(const urdf::Visual& visual, const std::string& place);
  std::string gazeboMaterialOf(const std::string& place) const;
  std::optional<int> materialOfGazebo(const std::string& place);
  std::optional<int> gazeboMaterialCalled(const std::string& name, const std::string& place);

  std::string origin_;
  GazeboMaterial of_gazebo_;  ///< of the link
  const ResourceFinder& finder_;
  SceneBuilder& builder_;
  std::map<std::string, int> material_by_content_;
  std::map<std::string, std::optional<int>> gazebo_material_by_name_;  ///< none where there is none
  ModelMeshes meshes_;
  UrdfLooks looks_;
  MaterialScripts scripts_;
};

}  // namespace sunlit::scene
