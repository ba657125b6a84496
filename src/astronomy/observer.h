/// What a place contributes to the positions of sun, moon and stars, computed once per place.
#pragma once

#include <Eigen/Core>

#include "sunlit/astronomy/sun_position.h"

namespace sunlit::astronomy {

/// Of the Earth, as in SPA.
constexpr double kEquatorialRadius_m = 6378140.0;

struct Observer {
  explicit Observer(const Site& site);

  double longitude_rad;
  double sin_latitude;
  double cos_latitude;
  double x;  ///< ρ cos φ′: distance from the Earth's axis, in equatorial radii
  double y;  ///< ρ sin φ′: distance from the plane of the equator
};

/// Rotation from the true equator and equinox of date to `map`. `sidereal_time`: apparent, at Greenwich.
Eigen::Matrix3d mapFromEquator(Angle sidereal_time, const Observer& observer);

SunPosition sunPosition(const SolarCoordinates& sun, const Observer& observer, const Air& air);

}  // namespace sunlit::astronomy
