/// SDF worlds and models by libsdformat.
#pragma once

#include <string>

#include "scene/resource_finder.h"
#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// All visuals and lights of the world or model in `file`, at their poses. Collisions, sensors and plugins
/// are not read. Throws std::runtime_error naming file and line of what cannot be read, and where a missing
/// file was looked for.
Scene loadSdf(const std::string& file, const ResourceFinder& finder);

}  // namespace sunlit::scene
