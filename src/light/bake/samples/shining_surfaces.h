/// Surfaces that shine by themselves.
#pragma once

#include <vector>

#include "light/bake/samples/area_lights.h"
#include "light/bake/samples/triangle_kinds.h"

namespace sunlit::light {

/// Of surfaces with Material::emission that belongs to no group of lamps: parts that shine evenly.
std::vector<AreaLights::Piece> shiningPieces(const Geometry& geometry,
                                             const std::vector<TriangleTraits>& traits);

}  // namespace sunlit::light
