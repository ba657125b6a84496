/// Where tests of the sky look, and through what air.
#pragma once

#include "sunlit/quantity/direction.h"
#include "sunlit/sky/atmosphere.h"
#include "support/usual_air.h"

namespace sunlit::sky {

inline Direction at(double azimuth_deg, double elevation_deg) {
  return Direction(Azimuth::degrees(azimuth_deg), Angle::degrees(elevation_deg));
}

}  // namespace sunlit::sky
