/// Command line options that say what is looked at, from where and how; shared by the tools that take
/// pictures.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "sunlit/image/exposure.h"
#include "sunlit/image/sensor_noise.h"
#include "sunlit/render/renderer.h"

namespace sunlit::tools {

struct ViewOptions {
  std::string world = "race_track";
  std::vector<std::string> model_folders;
  render::RenderOptions render;
  Eigen::Isometry3d map_from_optical = Eigen::Isometry3d::Identity();
  image::ExposureOptions exposure;
  image::NoiseOptions noise;
  bool bounced = true;  ///< surfaces hide the sky from each other and pass light on; false: an open sky
  std::string cache;    ///< folder for what that takes; empty: light::Transport::usualFolder()
};

/// Help for all of them.
extern const char* const kViewHelp;

/// Collects words until the camera can be placed.
class ViewArguments {
 public:
  /// False for an option that is none of these. Throws std::invalid_argument naming option, value and what is
  /// allowed.
  bool take(const std::string& key, const std::string& value);
  /// Throws std::invalid_argument for words that do not go together; what path::readWaypoints() throws.
  ViewOptions options() const;

 private:
  bool takeCamera(const std::string& key, const std::string& value);
  bool takeSensor(const std::string& key, const std::string& value);
  void placeTopDown(ViewOptions* options) const;
  void placeOnPath(ViewOptions* options) const;
  void placeFree(ViewOptions* options) const;

  ViewOptions options_;
  std::vector<double> pose_, look_at_, top_down_;  ///< empty if not given
  std::optional<int> path_pose_;
  std::string path_file_;
  int width_ = 640, height_ = 480;  ///< px
  double fov_deg_ = 90.0;
};

}  // namespace sunlit::tools
