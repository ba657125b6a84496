/// Stars through the air.
#pragma once

#include <vector>

#include "extinction.h"
#include "sunlit/sky/night.h"

namespace sunlit::sky {

/// The stars of `night` above the horizon, raised by refraction and dimmed, brightest first. None without a
/// celestial frame.
std::vector<PointLight> starsAbove(const NightSky& night, const Extinction& extinction);

}  // namespace sunlit::sky
