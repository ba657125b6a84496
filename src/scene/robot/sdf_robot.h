/// Robots from SDF.
#pragma once

#include <string>

#include "scene/resource_finder.h"
#include "sunlit/scene/robot.h"

namespace sunlit::scene {

/// The one model in `file`, with the models that it contains. Throws as loadRobot() does.
Robot loadSdfRobot(const std::string& file, const ResourceFinder& finder);

}  // namespace sunlit::scene
