/// Roads as SDF has them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sunlit/scene/scene.h"

namespace sunlit::scene {

/// A ribbon `width` m wide along `points`, m, at their heights and level across, facing up. At a bend both
/// edges keep their distance from the line, up to a turn of 120°, beyond which they come nearer. Texture
/// coordinates: u from 0 to 1 from left to right, v by one for each `width` along, as Gazebo classic repeats
/// its square textures. No triangle for less than two points that differ in the plane.
Mesh makeRibbon(const std::vector<Eigen::Vector3d>& points, double width);

}  // namespace sunlit::scene
