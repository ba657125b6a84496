/// The command line of `compare_light`.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "sunlit/light/reference.h"
#include "sunlit/render/renderer.h"

namespace sunlit::tools {

/// What lights the scene in one comparison.
struct SkyToCompare {
  std::string name;
  double azimuth_deg = 0.0;  ///< compass; of the sun, or where there is a moon of the moon
  double elevation_deg = 0.0;
  std::optional<double> moon_phase_deg;  ///< set: a night with this moon, 0 full
};

struct CompareLightOptions {
  std::string world = "race_track";
  std::vector<std::string> model_folders;
  std::string path;  ///< waypoint file; empty: the built-in path
  int views = 10;    ///< evenly along the path
  double height_m = 1.0;
  std::vector<Eigen::Isometry3d> map_from_camera;  ///< not empty: instead of a path
  std::vector<SkyToCompare> skies;
  render::RenderOptions render;
  light::ReferenceOptions reference;
  bool bake = true;    ///< false: the fast picture's sky is open, and nothing is bounced
  std::string cache;   ///< folder for the bake; empty: it is not kept
  std::string output;  ///< folder
};

/// What `--help` prints.
extern const char* const kCompareLightHelp;

/// Empty if help was asked for. Throws std::invalid_argument naming the option, its value and what is
/// allowed.
std::optional<CompareLightOptions> parseCompareLightOptions(const std::vector<std::string>& arguments);

}  // namespace sunlit::tools
