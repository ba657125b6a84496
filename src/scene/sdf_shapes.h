/// Shapes of SDF that libsdformat does not read by itself.
#pragma once

#include <optional>
#include <sdf/Element.hh>
#include <string>

#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// The solid of the <polyline> elements in a <geometry>: each is a loop, and those within others cut holes.
/// It reaches from z = 0 to the height of the first, as in Gazebo. None where there is no such element.
/// Throws std::runtime_error with `name` for a height that is not above 0.
std::optional<Mesh> polylineOf(sdf::Element& geometry, const std::string& name);

/// The ribbon of a <road>, in the frame of its world. Throws std::runtime_error with `name` for a width that
/// is not above 0.
Mesh roadOf(sdf::Element& road, const std::string& name);

}  // namespace sunlit::scene
