#include "sunlit/astronomy/celestial.h"

#include <erfa.h>

#include <cmath>

#include "astronomy/geocentric_sun.h"
#include "astronomy/observer.h"

namespace sunlit::astronomy {
namespace {

using RowMajorMatrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

}  // namespace

Eigen::Matrix3d mapFromCelestial(const Instant& instant, const EarthRotation& earth, const Site& site) {
  const GeocentricSun sun = geocentricSun(instant, earth);
  RowMajorMatrix mean_from_celestial, true_from_mean;
  double rows[3][3];
  eraLtpb(2000.0 + 100.0 * sun.times.jce, rows);
  mean_from_celestial = Eigen::Map<const RowMajorMatrix>(&rows[0][0]);
  eraNumat(sun.nutation.mean_obliquity_arcsec / 3600.0 * kRadPerDeg, sun.nutation.longitude_deg * kRadPerDeg,
           sun.nutation.obliquity_deg * kRadPerDeg, rows);
  true_from_mean = Eigen::Map<const RowMajorMatrix>(&rows[0][0]);
  return mapFromEquator(Angle::degrees(sun.nu), Observer(site)) * true_from_mean * mean_from_celestial;
}

Eigen::Vector3d equatorial(Angle right_ascension, Angle declination) {
  return {cos(declination) * cos(right_ascension), cos(declination) * sin(right_ascension), sin(declination)};
}

}  // namespace sunlit::astronomy
