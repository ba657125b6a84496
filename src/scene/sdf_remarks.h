/// What an SDF file asks for and does not get.
#pragma once

#include <tinyxml2.h>

#include <string>

#include "scene/scene_builder.h"

namespace sunlit::scene {

/// Names what of `sdf`, the root element of `file`, is otherwise here than in a simulator: what its cameras
/// do not see, fog, background and shadows of its <scene>, and where it is turned to; each kind a warning of
/// `builder`. What worlds have as they are made is nothing that they ask for.
void remarkOnSdf(tinyxml2::XMLElement& sdf, const std::string& file, SceneBuilder& builder);

/// Names numbers of `element`, where it is one of numbers alone, that end in something else.
void remarkOnNumbers(const tinyxml2::XMLElement& element, const std::string& file, SceneBuilder& builder);

}  // namespace sunlit::scene
