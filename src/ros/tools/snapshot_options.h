/// The command line of `snapshot`.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "sunlit/image/exposure.h"
#include "sunlit/render/renderer.h"

namespace sunlit::tools {

struct SnapshotOptions {
  std::string world = "race_track";
  std::vector<std::string> model_folders;
  render::RenderOptions render;
  Eigen::Isometry3d map_from_optical = Eigen::Isometry3d::Identity();
  std::optional<double> top_down_height_m;    ///< set: a view from straight above, pose ignored
  Angle sun_azimuth = Angle::degrees(180.0);  ///< compass
  Angle sun_elevation = Angle::degrees(40.0);
  image::ExposureOptions exposure;
  std::string output;
  std::string depth_output;  ///< empty: none
};

/// What `--help` prints.
extern const char* const kSnapshotHelp;

/// Empty if help was asked for. Throws std::invalid_argument naming the option, its value and what is
/// allowed.
std::optional<SnapshotOptions> parseSnapshotOptions(const std::vector<std::string>& arguments);

}  // namespace sunlit::tools
