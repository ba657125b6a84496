/// Waypoints to camera poses.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace sunlit::path {

/// Points in `map`, m, in driving order, on the ground that the camera drives over.
using Waypoints = std::vector<Eigen::Vector3d>;

struct PathOptions {
  double spacing_m = 1.0;  ///< distance of consecutive poses within a segment, 0.001 … 1000 m
  double height_m = 1.0;   ///< of the camera above the waypoints, −1000 … 1000 m
};

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
