/// Command line options of the poses along a path.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "sunlit/path/path.h"
#include "sunlit/studio/command_line.h"
#include "sunlit/studio/world.h"

namespace sunlit::tools {

/// What --path takes, for people; `what` it is for.
std::string pathDoc(const std::string& what);

/// Those of `file`, of which it says on stderr how many poses it left out; of the built-in world where that
/// is empty. Throws what path.h throws.
path::Waypoints waypointsOf(const std::string& file);

struct PathWords {
  std::string file;  ///< empty: the path of the built-in world
  path::PathOptions sampling;
  path::PoseSelection selection;
};

/// --path, --spacing, --height, --first, --count and --stride.
void addPath(studio::CommandLine* line, PathWords* words);

/// As waypointsOf() of their file; warns on stderr of path::crowdedText(). Throws what studio::requireWorld()
/// throws, too, and std::invalid_argument where `world` has no path of its own, and none is given.
path::Waypoints waypointsOf(const PathWords& words, const studio::WorldOptions& world);

/// map_from_camera_link of all poses along the path, of which those that are selected are there. Throws what
/// path.h throws.
std::vector<Eigen::Isometry3d> posesAlong(const path::Waypoints& waypoints, const PathWords& words);

/// Both of these.
std::vector<Eigen::Isometry3d> posesOf(const PathWords& words, const studio::WorldOptions& world);

}  // namespace sunlit::tools
