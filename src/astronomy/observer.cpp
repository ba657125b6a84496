#include "astronomy/observer.h"

#include <cmath>

namespace sunlit::astronomy {

Observer::Observer(const Site& site)
    : longitude_rad(site.longitude.rad()),
      sin_latitude(sin(site.latitude)),
      cos_latitude(cos(site.latitude)) {
  // Reda & Andreas (2008), eq. 34 to 36: the flattened Earth. u = atan(0.99664719 tan φ), written so that it
  // holds at the poles.
  constexpr double kPolarRadius = 0.99664719;
  const double height = site.elevation_m / kEquatorialRadius_m;
  const double u = std::atan2(kPolarRadius * sin_latitude, cos_latitude);
  x = std::cos(u) + height * cos_latitude;
  y = kPolarRadius * std::sin(u) + height * sin_latitude;
}

Eigen::Matrix3d mapFromEquator(Angle sidereal_time, const Observer& observer) {
  const double local = sidereal_time.rad() + observer.longitude_rad;
  const Eigen::Vector3d to_meridian(std::cos(local), std::sin(local), 0.0);  // on the equator, above it
  const Eigen::Vector3d pole = Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d map_from_equator;
  map_from_equator.row(0) << -to_meridian.y(), to_meridian.x(), 0.0;
  map_from_equator.row(1) = observer.cos_latitude * pole - observer.sin_latitude * to_meridian;
  map_from_equator.row(2) = observer.sin_latitude * pole + observer.cos_latitude * to_meridian;
  return map_from_equator;
}

}  // namespace sunlit::astronomy
