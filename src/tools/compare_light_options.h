/// The command line of `compare_light`.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "sunlit/light/reference.h"
#include "sunlit/path/path.h"
#include "sunlit/quantity/field.h"
#include "sunlit/render/renderer.h"
#include "sunlit/scene/weathering.h"
#include "sunlit/sky/weather.h"
#include "sunlit/studio/world.h"
#include "tools/path_arguments.h"

namespace sunlit::tools {

/// What lights the scene in one comparison.
struct SkyToCompare {
  std::string name;
  double azimuth_deg = 0.0;  ///< compass; of the sun, or where there is a moon of the moon
  double elevation_deg = 0.0;
  std::optional<double> moon_phase_deg;  ///< set: a night with this moon
};

/// As typed; of a sun without the phase.
struct TypedBody {
  double azimuth_deg = 0.0;
  double elevation_deg = 0.0;
  double phase_deg = 0.0;
};

inline std::vector<Field> fieldsOf(TypedBody& body) {
  return {{"azimuth", &body.azimuth_deg, "deg", {}, "clockwise from north"},
          {"elevation", &body.elevation_deg, "deg", {-90, 90}, ""},
          {"phase", &body.phase_deg, "deg", {0, 180}, "0 is full"}};
}

struct CompareLightOptions {
  studio::WorldOptions world;
  studio::BakeOptions bake;  ///< without it the fast picture's sky is open
  light::LampOptions lamps;
  sky::Weather weather;  ///< of all skies
  scene::SurfaceState surfaces;
  std::string path;  ///< waypoint file; empty: the built-in path
  int views = 10;    ///< evenly along the path
  path::PathOptions sampling;
  std::vector<Eigen::Isometry3d> map_from_camera;  ///< not empty: instead of a path
  std::vector<SkyToCompare> skies;
  render::RenderOptions render;
  int every = 8;
  light::ReferenceOptions reference;
  std::string output;  ///< folder
};

inline std::vector<Field> fieldsOf(CompareLightOptions& options) {
  return {
      {"out",
       &options.output,
       "",
       {},
       "folder for table.csv, table.md, and a picture of each view and sun: fast | traced | relative error "
       "(red too bright, blue too dark, full at 50 %)"},
      {"path", &options.path, "", {}, pathDoc("waypoints to place views along")},
      {"views", &options.views, "", {1, 1000}, "how many, evenly along the path"},
      {"every",
       &options.every,
       "px",
       {1, 64},
       "compares every Nth pixel across and down, so that pixels are as small as in use and the tracing "
       "takes no hours"}};
}

/// Empty if help was asked for, and has been printed. Throws std::invalid_argument naming the option, its
/// value and what is allowed.
std::optional<CompareLightOptions> parseCompareLightOptions(const std::vector<std::string>& arguments);

}  // namespace sunlit::tools
