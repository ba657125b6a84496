#include "sunlit/astronomy/sun_position.h"

#include <algorithm>
#include <cmath>

#include "astronomy/observer.h"
#include "sunlit/astronomy/refraction.h"

namespace sunlit::astronomy {
namespace {

double inHalfTurns(double rad) {
  return rad - 2.0 * kPi * std::ceil(rad / (2.0 * kPi) - 0.5);
}

double inTurn(double rad) {
  const double in_turn = rad - 2.0 * kPi * std::floor(rad / (2.0 * kPi));
  return in_turn < 2.0 * kPi ? in_turn : 0.0;
}

}  // namespace

SunPosition sunPosition(const SolarCoordinates& sun, const Observer& observer, const Air& air) {
  // Eq. 33 and 38 to 40: parallax.
  const double sin_parallax = std::sin(8.794 / (3600.0 * sun.distance_au) * kRadPerDeg);
  const double hour_angle =
      sun.apparent_sidereal_time.rad() + observer.longitude_rad - sun.right_ascension.rad();
  const double cos_declination = cos(sun.declination);
  const double towards_meridian = cos_declination - observer.x * sin_parallax * std::cos(hour_angle);
  const double across_meridian = observer.x * sin_parallax * std::sin(hour_angle);
  const double alpha_shift = std::atan2(-across_meridian, towards_meridian);
  const double declination = std::atan2(
      (sin(sun.declination) - observer.y * sin_parallax) * std::cos(alpha_shift), towards_meridian);
  const double topocentric_hour_angle = hour_angle - alpha_shift;

  // Eq. 41 and 45 as one vector, which keeps its digits at the zenith and at the poles.
  const double sin_declination = std::sin(declination);
  const double cos_topocentric_declination = std::cos(declination);
  const double to_south = cos_topocentric_declination * std::cos(topocentric_hour_angle);
  const double east = -cos_topocentric_declination * std::sin(topocentric_hour_angle);
  const double north = sin_declination * observer.cos_latitude - to_south * observer.sin_latitude;
  const double up = sin_declination * observer.sin_latitude + to_south * observer.cos_latitude;

  SunPosition position;
  position.azimuth = Azimuth(Angle::radians(std::atan2(east, north)));
  // Not by hypot(), whose last bit C libraries round otherwise for another processor; a root's they do not.
  position.elevation_geometric = Angle::radians(std::atan2(up, std::sqrt(east * east + north * north)));
  position.elevation = position.elevation_geometric + refraction(position.elevation_geometric, air);
  position.right_ascension = Angle::radians(inTurn(sun.right_ascension.rad() + alpha_shift));
  position.declination = Angle::radians(declination);
  position.hour_angle = Angle::radians(inHalfTurns(topocentric_hour_angle));
  return position;
}

SunPosition sunPosition(const SolarCoordinates& sun, const Site& site, const Air& air) {
  return sunPosition(sun, Observer(site), air);
}

std::vector<SunPosition> sunPositions(const SolarCoordinates& sun, const std::vector<Site>& sites,
                                      const Air& air) {
  std::vector<SunPosition> positions;
  positions.reserve(sites.size());
  for (const Site& site : sites) positions.push_back(sunPosition(sun, Observer(site), air));
  return positions;
}

std::vector<SunPosition> sunPositions(const std::vector<Instant>& instants, const EarthRotation& earth,
                                      const Site& site, const Air& air) {
  const Observer observer(site);
  std::vector<SunPosition> positions;
  positions.reserve(instants.size());
  for (const Instant& instant : instants) {
    positions.push_back(sunPosition(solarCoordinates(instant, earth), observer, air));
  }
  return positions;
}

SunPosition sunPosition(const Instant& instant, const EarthRotation& earth, const Site& site,
                        const Air& air) {
  return sunPosition(solarCoordinates(instant, earth), Observer(site), air);
}

Angle incidence(const SunPosition& sun, const Surface& surface) {
  const Angle from_south = sun.azimuth.angle() - Angle::degrees(180.0);
  const double cosine = cos(sun.zenith()) * cos(surface.slope) +
                        sin(surface.slope) * sin(sun.zenith()) * cos(from_south - surface.azm_rotation);
  return Angle::radians(std::acos(std::clamp(cosine, -1.0, 1.0)));
}

}  // namespace sunlit::astronomy
