/// What the land around a world is like, as far as the world itself can tell.
#pragma once

#include <optional>

#include "sunlit/light/world.h"

namespace sunlit::light {

/// Share of the light that `world` sends back, 0 … 1, a multiple of 0.001: the mean over all that an eye high
/// above sees, by level area, of what stands still, as luminance. Cut-outs and what blends let through; a
/// one-sided surface is not seen from behind. Of surfaces alone: shade that they cast on each other would
/// lower it. Nothing where nothing is seen. By 2^18 places, which is within 0.002 of the mean; takes tenths
/// of a second, and the same number for any number of threads.
std::optional<double> albedoFromAbove(const World& world);

/// z of the ground in `map`, m: half of all that an eye high above sees of what stands still, by level area,
/// lies no higher. 0 where nothing is seen. By 2^12 places, in some milliseconds.
float groundLevel(const Geometry& geometry, const Visibility& visibility);

}  // namespace sunlit::light
