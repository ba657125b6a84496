/// Parked cars, vans and lorries.
#pragma once

#include "scene/race_track/shapes.h"

namespace sunlit::scene::race_track {

/// On the ground at the origin of `frame`, driving towards its x.
void addCar(Assembly& assembly, const Frame& frame, std::uint32_t seed);
void addVan(Assembly& assembly, const Frame& frame, std::uint32_t seed);
void addLorry(Assembly& assembly, const Frame& frame, std::uint32_t seed);

}  // namespace sunlit::scene::race_track
