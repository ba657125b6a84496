/// Water and snow on what a camera sees.
#pragma once

#include "sunlit/light/geometry.h"
#include "sunlit/light/surfaces.h"

namespace sunlit::render {

/// Of surfaces of `geometry`, as dry as they were resolved; what moves stays so. Nothing where it has no
/// weathering.
void weatherSurfaces(const light::Geometry& geometry, light::Surfaces* surfaces);

}  // namespace sunlit::render
