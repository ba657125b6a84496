/// What most tests of the sky look at.
#pragma once

#include "sunlit/quantity/direction.h"
#include "sunlit/sky/atmosphere.h"

namespace sunlit::sky {

/// The air of default options; made once a program, since it takes a second.
inline const Atmosphere& clearAir() {
  static const Atmosphere atmosphere{AtmosphereOptions{}};
  return atmosphere;
}

inline Direction at(double azimuth_deg, double elevation_deg) {
  return Direction(Azimuth::degrees(azimuth_deg), Angle::degrees(elevation_deg));
}

}  // namespace sunlit::sky
