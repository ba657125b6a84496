/// Command line options that say what is looked at, from where and how; shared by the tools that take
/// pictures.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "ros/tools/camera_arguments.h"
#include "ros/tools/world_arguments.h"
#include "sunlit/image/exposure.h"
#include "sunlit/image/sensor_noise.h"
#include "sunlit/render/renderer.h"

namespace sunlit::tools {

struct ViewOptions {
  WorldOptions world;
  render::RenderOptions render;
  Eigen::Isometry3d map_from_optical = Eigen::Isometry3d::Identity();
  image::ExposureOptions exposure;
  image::NoiseOptions noise;
};

/// Help for all of them.
std::string viewHelp();

/// Collects words until the camera can be placed.
class ViewArguments {
 public:
  /// False for an option that is none of these. Throws std::invalid_argument naming option, value and what is
  /// allowed.
  bool take(const std::string& key, const std::string& value);
  /// Throws std::invalid_argument for words that do not go together; what path::readWaypoints() throws.
  ViewOptions options() const;

 private:
  bool takePlace(const std::string& key, const std::string& value);
  bool takeSensor(const std::string& key, const std::string& value);
  /// Throws for an option that another one makes meaningless.
  void requireThatAllCount() const;
  void placeTopDown(ViewOptions* options) const;
  void placeOnPath(ViewOptions* options) const;
  void placeFree(ViewOptions* options) const;

  ViewOptions options_;
  std::vector<double> pose_, look_at_, top_down_;  ///< empty if not given
  std::optional<int> path_pose_;
  std::string path_file_;
  CameraWords camera_;
  bool has_compensation_ = false;
};

}  // namespace sunlit::tools
