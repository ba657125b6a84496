/// The lights of glTF files.
#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <string>

#include "scene/scene_builder.h"

namespace sunlit::scene {

/// Adds the points and spots of `root`, that of `file` (KHR_lights_punctual, in cd), one for each node that
/// has one: Assimp keeps but one of those that share a light. Directional ones are a warning. Throws
/// std::runtime_error naming the file if its lights are not as the extension has them.
void addGltfLights(const nlohmann::json& root, const std::string& file, const Eigen::Affine3d& up_from_file,
                   SceneBuilder& builder);

}  // namespace sunlit::scene
