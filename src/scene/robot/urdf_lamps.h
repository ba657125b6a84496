/// The lights of a URDF: it has no word for them, but what Gazebo adds to it does.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene/scene_builder.h"
#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// Lamps by their link, in its frame: of <light> elements, as SDF has them, in <gazebo reference="link">.
/// What cannot be read of them becomes a warning of `builder`. `text` is well-formed XML.
std::map<std::string, std::vector<Lamp>> urdfLamps(const std::string& text, SceneBuilder& builder);

}  // namespace sunlit::scene
