/// A URDF in the place of an SDF model.
#pragma once

#include <tinyxml2.h>

#include <memory>
#include <string>

#include "scene/resource_finder.h"
#include "scene/scene_builder.h"

namespace sunlit::scene {

/// What Gazebo makes of the URDF in `urdf`, which it changes: by libsdformat, links at fixed joints become
/// one, those without <inertial> are left out, joints are at 0. Meshes of packages are found as in a URDF
/// alone. What is lost is a warning. `file` names it; throws std::runtime_error where libsdformat cannot read
/// it.
std::unique_ptr<tinyxml2::XMLDocument> sdfOfUrdf(tinyxml2::XMLDocument& urdf, const std::string& file,
                                                 const ResourceFinder& finder, SceneBuilder& builder);

}  // namespace sunlit::scene
