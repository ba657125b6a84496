/// The command line of `compare_light`.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "ros/tools/world_arguments.h"
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
  WorldOptions world;  ///< without bounced light the fast picture's sky is open
  std::string path;    ///< waypoint file; empty: the built-in path
  int views = 10;      ///< evenly along the path
  double height_m = 1.0;
  std::vector<Eigen::Isometry3d> map_from_camera;  ///< not empty: instead of a path
  std::vector<SkyToCompare> skies;
  render::RenderOptions render;
  int every = 8;  ///< px: only one pixel of so many, across and down, is traced and compared
  light::ReferenceOptions reference;
  std::string output;  ///< folder
};

/// Prints what `--help` asks for.
void printCompareLightHelp();

/// Empty if help was asked for. Throws std::invalid_argument naming the option, its value and what is
/// allowed.
std::optional<CompareLightOptions> parseCompareLightOptions(const std::vector<std::string>& arguments);

}  // namespace sunlit::tools
