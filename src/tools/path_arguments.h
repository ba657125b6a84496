/// Command line options of the poses along a path.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "sunlit/path/path.h"
#include "sunlit/studio/command_line.h"
#include "sunlit/studio/world.h"

namespace sunlit::tools {

struct PathWords {
  std::string file;  ///< empty: the path of the built-in world
  path::PathOptions sampling;
  path::PoseSelection selection;
};

/// --path, --spacing, --height, --first, --count and --stride.
void addPath(studio::CommandLine* line, PathWords* words);

/// map_from_camera_link of all poses along the path, of which those that are selected are there. Throws what
/// studio::requireWorld() throws, std::invalid_argument where `world` has no path of its own, and none is
/// given; and what path.h throws.
std::vector<Eigen::Isometry3d> posesOf(const PathWords& words, const studio::WorldOptions& world);

}  // namespace sunlit::tools
