/// The robot that carries the camera, as parameters tell of it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "sunlit/ros/parameter_reader.h"
#include "sunlit/scene/robot.h"

namespace sunlit::ros_interface {

/// How joints stand: by TF if the camera follows TF, at rest, or by TF.
enum class Joints { kAuto, kRest, kTf };

struct RobotOptions {
  std::string description;  ///< name of a parameter that holds a URDF; empty: none
  std::string file;         ///< URDF or SDF; empty: none. Neither: no robot
  std::string base_frame;   ///< the link that is placed; empty: the root

  /// On a path: where the camera is in the base frame, m; or on which link; neither: see RobotPlaces.
  std::optional<Eigen::Vector3d> camera_in_base;
  std::string camera_link;

  Joints joints = Joints::kAuto;
  bool joints_by_tf = false;  ///< what joints comes to; else in rest position
  double tf_patience_s = 1.0;
  std::string tf_prefix;  ///< "a" where TF calls the link b "a/b"; empty: "b"

  bool none() const { return description.empty() && file.empty(); }
};

std::vector<Field> fieldsOf(RobotOptions& robot);

/// What rows alone do not tell: robot/camera_in_base, and joints_by_tf. `follows_tf`: the camera follows a TF
/// frame, and so do joints unless told otherwise. Throws std::invalid_argument with name, value and what is
/// allowed.
void readRobotForms(const ParameterReader& parameters, bool follows_tf, RobotOptions* robot);

/// The robot that `options` name; none if they name none. Meshes are looked for in `search_path`. Throws
/// std::invalid_argument for a parameter that does not hold a text, or a link that the robot does not have,
/// and what scene::loadRobot() throws.
std::optional<scene::Robot> loadRobot(const RobotOptions& options, const scene::SearchPath& search_path);

}  // namespace sunlit::ros_interface
