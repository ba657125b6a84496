/// What a place contributes to the sun's position, computed once per place.
#pragma once

#include "sunlit/astronomy/sun_position.h"

namespace sunlit::astronomy {

struct Observer {
  explicit Observer(const Site& site);

  double longitude_rad;
  double sin_latitude;
  double cos_latitude;
  double x;  ///< ρ cos φ′: distance from the Earth's axis, in equatorial radii
  double y;  ///< ρ sin φ′: distance from the plane of the equator
};

SunPosition sunPosition(const SolarCoordinates& sun, const Observer& observer, const Air& air);

}  // namespace sunlit::astronomy
