/// Waypoints to camera poses.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "sunlit/quantity/field.h"

namespace sunlit::path {

/// Points in `map`, m, in driving order, on the ground that the camera drives over.
using Waypoints = std::vector<Eigen::Vector3d>;

struct PathOptions {
  double spacing_m = 1.0;
  double height_m = 1.0;
};

inline std::vector<Field> fieldsOf(PathOptions& options) {
  return {{"spacing", &options.spacing_m, "m", {0.001, 1000}, "between poses of one segment"},
          {"camera_height", &options.height_m, "m", {-1000, 1000}, "of the camera above the waypoints"}};
}

/// Throws std::invalid_argument naming key, value and range.
void validate(const PathOptions& options);

/// map_from_camera_link of every pose, by the paper's rule: poses every `spacing_m` from the start of each
/// segment between two waypoints, while short of its end; then the start of the next segment. The camera is
/// level (parallel to the ground plane) and points at the next waypoint in plan view. Throws
/// std::invalid_argument naming the waypoint for fewer than two points, a coordinate that is not within
/// ±10,000 km, two consecutive points less than 1 mm apart in plan view, or more than 10 million poses.
std::vector<Eigen::Isometry3d> posesAlong(const Waypoints& waypoints, const PathOptions& options);

/// Waypoints from a file: CSV (x,y,z or x,y a line, m; an optional header line; # comments) or TUM trajectory
/// (timestamp tx ty tz qx qy qz qw, blank-separated; the orientation is not used). Which of the two is told
/// by commas. Throws std::runtime_error with path, line and what is wrong there; all that posesAlong checks
/// is checked here too.
Waypoints readWaypoints(const std::string& file);

}  // namespace sunlit::path
