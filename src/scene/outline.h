/// Flat outlines pulled up into solids.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sunlit/scene/scene.h"

namespace sunlit::scene {

using Outline = std::vector<Eigen::Vector2d>;  ///< m; closed, whether its last point is the first or not

/// What lies within an odd number of `outlines`, which may cross themselves and each other, from z = 0 to
/// `height`, m, > 0: floor, top and walls with normals outwards. Points are rounded to kOutlineGrid_m.
/// Texture coordinates are m. No triangle if nothing is enclosed.
Mesh extruded(const std::vector<Outline>& outlines, double height);

/// A tenth of a millimetre, so that whole numbers of 32 bit reach kFarthest_m.
constexpr double kOutlineGrid_m = 1e-4;

}  // namespace sunlit::scene
