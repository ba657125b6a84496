/// Instances of COLLADA files that show nothing.
#pragma once

#include <tinyxml2.h>

#include <string>

#include "scene/scene_builder.h"

namespace sunlit::scene {

/// Names those in the scene of `root`, whose nodes go in no circles: Assimp passes over what they refer to
/// where that is not there, or is no <mesh>.
void warnOfLostInstances(tinyxml2::XMLElement& root, const std::string& file, SceneBuilder& builder);

/// `text` in which instances of what is in other files refer to what is not in this one: Assimp refuses all
/// of a file for one of those, and passes over these. Lines stay where they are.
std::string withInstancesWithin(const std::string& text);

}  // namespace sunlit::scene
