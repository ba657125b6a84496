/// A robot: rigid links with their looks, held together by joints.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "sunlit/scene/load.h"
#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// One rigid part.
struct RobotLink {
  std::string name;  ///< also of its TF frame
  int parent = -1;   ///< index into Robot::links, below this link's own; −1 for the root
  /// With the joint between them where Robot says.
  Eigen::Isometry3d parent_from_link = Eigen::Isometry3d::Identity();
  std::vector<Mesh> meshes;  ///< in the link's frame; `material` is an index into Robot::materials
  std::vector<Lamp> lamps;   ///< in the link's frame
};

/// What there is to see of a robot, in the rest position of its joints: zero where the limits allow it, else
/// the middle between them, and as their leaders say where they mimic others, as joint_state_publisher has
/// it.
struct Robot {
  std::string name;
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<RobotLink> links;       ///< parents before their children; the first is the root
  std::vector<std::string> warnings;  ///< what was amiss in its files and how it was made good, a line each

  std::size_t triangleCount() const;
  std::optional<std::size_t> indexOf(const std::string& link) const;
  /// In rest position, one a link. `base` is an index into links.
  std::vector<Eigen::Isometry3d> baseFromLinks(std::size_t base) const;
};

/// By the ending of the file's name: .urdf (or .xml), or .sdf with one model, whose root link then is a frame
/// without looks, named after the model. Only visuals and lights are read, of a URDF
/// those in <gazebo reference="link">. Meshes are looked for as package:// of the
/// folders in `search_path`, the folder of the file and its parents; file://; or by a relative path. Throws
/// std::runtime_error naming file and place, and for a missing file where it was looked for.
Robot loadRobot(const std::string& file, const SearchPath& search_path);

/// A robot from the text of a URDF; `origin` names it in messages, and is the file it came from, if any.
Robot parseUrdf(const std::string& text, const std::string& origin, const SearchPath& search_path);

/// Appends the textures and materials of `robot` to those of `scene`, so that one list of materials holds for
/// both, and gives the links' meshes with materials of that list, one vector a link.
std::vector<std::vector<Mesh>> addLooks(const Robot& robot, Scene* scene);

}  // namespace sunlit::scene
