/// A sky of even brightness: for scenes whose light can be worked out on paper, and for studies of light.
#pragma once

#include "sunlit/sky/daylight.h"

namespace sunlit::sky {

struct UniformSky {
  LinearRgb luminance;         ///< cd/m² everywhere above the horizon, ≥ 0
  double ground_albedo = 0.0;  ///< of the land below the horizon, 0 … 1; with 1 and no sun it is as bright as
                               ///< the sky
  DiscLight sun;  ///< zero illuminance: none
};

/// Without air between eye and surface. Throws std::invalid_argument naming key, value and range.
Daylight uniformDaylight(const UniformSky& sky);

}  // namespace sunlit::sky
