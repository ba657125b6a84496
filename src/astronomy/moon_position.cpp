#include "sunlit/astronomy/moon_position.h"

#include <erfam.h>

#include <Eigen/Geometry>
#include <cmath>

#include "astronomy/degrees.h"
#include "astronomy/geocentric_sun.h"
#include "astronomy/moon_of_date.h"
#include "astronomy/observer.h"
#include "sunlit/astronomy/celestial.h"
#include "sunlit/astronomy/refraction.h"
#include "sunlit/quantity/moon.h"

namespace sunlit::astronomy {
namespace {

struct Spherical {
  Angle right_ascension;
  Angle declination;
};

Spherical sphericalOf(const Eigen::Vector3d& vector) {
  return {Angle::degrees(inTurn(std::atan2(vector.y(), vector.x()) / kRadPerDeg)),
          Angle::radians(std::atan2(vector.z(), vector.head<2>().norm()))};
}

Angle between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return Angle::radians(std::atan2(a.cross(b).norm(), a.dot(b)));
}

/// Meeus, eq. 48.5.
Angle brightLimb(const Spherical& moon, const Spherical& sun) {
  const Angle ahead = sun.right_ascension - moon.right_ascension;
  const double east = cos(sun.declination) * sin(ahead);
  const double north = sin(sun.declination) * cos(moon.declination) -
                       cos(sun.declination) * sin(moon.declination) * cos(ahead);
  return Angle::degrees(inTurn(std::atan2(east, north) / kRadPerDeg));
}

}  // namespace

Angle MoonPosition::angularRadius() const {
  return Angle::radians(std::asin(kMoonRadius_m / distance_m));
}

LunarCoordinates lunarCoordinates(const Instant& instant, const EarthRotation& earth) {
  const JulianTimes times = julianTimes(instant, earth);
  const Eigen::Vector3d of_date = moonOfDate(times.jce, nutation(times.jce));
  const Spherical spherical = sphericalOf(of_date);
  return {spherical.right_ascension, spherical.declination, of_date.norm() * ERFA_DAU};
}

MoonPosition moonPosition(const LunarCoordinates& moon, const SolarCoordinates& sun, const Site& site,
                          const Air& air) {
  const Observer observer(site);
  const double local = sun.apparent_sidereal_time.rad() + observer.longitude_rad;
  const Eigen::Vector3d from_centre =
      kEquatorialRadius_m *
      Eigen::Vector3d(observer.x * std::cos(local), observer.x * std::sin(local), observer.y);
  const Eigen::Vector3d to_moon =
      moon.distance_m * equatorial(moon.right_ascension, moon.declination) - from_centre;
  const Eigen::Vector3d to_sun =
      sun.distance_au * ERFA_DAU * equatorial(sun.right_ascension, sun.declination) - from_centre;
  const Eigen::Vector3d in_map = mapFromEquator(sun.apparent_sidereal_time, observer) * to_moon;
  const Spherical seen = sphericalOf(to_moon);

  MoonPosition position;
  position.azimuth = Azimuth(Angle::radians(std::atan2(in_map.x(), in_map.y())));
  position.elevation_geometric = Angle::radians(std::atan2(in_map.z(), in_map.head<2>().norm()));
  position.elevation = position.elevation_geometric + refraction(position.elevation_geometric, air);
  position.right_ascension = seen.right_ascension;
  position.declination = seen.declination;
  position.distance_m = to_moon.norm();
  position.phase_angle = between(-to_moon, to_sun - to_moon);
  position.illuminated_fraction = 0.5 * (1.0 + cos(position.phase_angle));
  position.bright_limb = brightLimb(seen, sphericalOf(to_sun));
  return position;
}

MoonPosition moonPosition(const Instant& instant, const EarthRotation& earth, const Site& site,
                          const Air& air) {
  return moonPosition(lunarCoordinates(instant, earth), solarCoordinates(instant, earth), site, air);
}

}  // namespace sunlit::astronomy
