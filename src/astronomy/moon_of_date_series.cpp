#include <erfa.h>
#include <erfam.h>

#include <Eigen/Geometry>

#include "astronomy/degrees.h"
#include "astronomy/moon_of_date.h"
#include "astronomy/moon_series.h"

namespace sunlit::astronomy {

Eigen::Vector3d moonOfDate(double jce, const Nutation& wobble) {
  constexpr double kJ2000 = 2451545.0;
  const EclipticMoon moon = moonByMeeus(jce);
  // The obliquity by which ERFA would turn it.
  const double obliquity = eraObl06(kJ2000, jce * 36525.0) + wobble.obliquity_deg * kRadPerDeg;
  const double longitude_deg = moon.longitude_deg + wobble.longitude_deg;
  const Eigen::Vector3d direction(cosDeg(moon.latitude_deg) * cosDeg(longitude_deg),
                                  cosDeg(moon.latitude_deg) * sinDeg(longitude_deg),
                                  sinDeg(moon.latitude_deg));
  return moon.distance_m / ERFA_DAU * (Eigen::AngleAxisd(obliquity, Eigen::Vector3d::UnitX()) * direction);
}

}  // namespace sunlit::astronomy
