#include "astronomy/geocentric_sun.h"

#include <cmath>

#include "astronomy/degrees.h"
#include "sunlit/astronomy/delta_t.h"

namespace sunlit::astronomy {
namespace {

constexpr double kSecondsPerDay = 86400.0;

/// Eq. 28. The 360° a day come from the fraction alone, so that whole days cost no digits.
double meanSiderealTime(const JulianTimes& times) {
  const double jc = times.jd_since_2000 / 36525.0;
  return inTurn(280.46061837 + 360.0 * times.day_fraction + 0.98564736629 * times.jd_since_2000 +
                jc * jc * (0.000387933 - jc / 38710000.0));
}

/// A.1: the mean longitude of the sun.
double meanLongitude(double jme) {
  return inTurn(280.4664567 + jme * (360007.6982779 +
                                     jme * (0.03032028 + jme * (1.0 / 49931.0 +
                                                                jme * (-1.0 / 15300.0 - jme / 2000000.0)))));
}

}  // namespace

JulianTimes julianTimes(const Instant& instant, const EarthRotation& earth) {
  const Instant ut1 = instant.plusSeconds(earth.delta_ut1_s);
  const double delta_t_s = earth.delta_t_s ? *earth.delta_t_s : deltaT(instant);
  JulianTimes times;
  times.day_fraction = ut1.dayFraction();
  times.jd_since_2000 = static_cast<double>(ut1.julianDay() - 2451545) + times.day_fraction;
  times.jce = (times.jd_since_2000 + delta_t_s / kSecondsPerDay) / 36525.0;
  times.jme = times.jce / 10.0;
  return times;
}

GeocentricSun geocentricSun(const Instant& instant, const EarthRotation& earth) {
  GeocentricSun sun;
  sun.times = julianTimes(instant, earth);
  sun.earth = earthOrbit(sun.times.jme);
  sun.nutation = nutation(sun.times.jce);
  sun.theta = inTurn(sun.earth.longitude_deg + 180.0);
  sun.beta = -sun.earth.latitude_deg;
  sun.dtau = -20.4898 / (3600.0 * sun.earth.distance_au);
  sun.lambda = inTurn(sun.theta + sun.nutation.longitude_deg + sun.dtau);

  const double epsilon = sun.nutation.true_obliquity_deg;
  sun.nu0 = meanSiderealTime(sun.times);
  sun.nu = inTurn(sun.nu0 + sun.nutation.longitude_deg * cosDeg(epsilon));

  // Eq. 30 and 31; tan β written out, so that one formula serves.
  const double sin_lambda = sinDeg(sun.lambda);
  const double cos_beta = cosDeg(sun.beta);
  const double sin_beta = sinDeg(sun.beta);
  sun.alpha = inTurn(
      std::atan2(sin_lambda * cosDeg(epsilon) - sin_beta / cos_beta * sinDeg(epsilon), cosDeg(sun.lambda)) /
      kRadPerDeg);
  sun.delta = std::asin(sin_beta * cosDeg(epsilon) + cos_beta * sinDeg(epsilon) * sin_lambda) / kRadPerDeg;

  sun.m = meanLongitude(sun.times.jme);
  // 4 min a degree; within ±20 min, so the difference of the two longitudes is taken the short way round.
  sun.eot_min =
      4.0 * inHalfTurns(sun.m - 0.0057183 - sun.alpha + sun.nutation.longitude_deg * cosDeg(epsilon));
  return sun;
}

SolarCoordinates solarCoordinates(const Instant& instant, const EarthRotation& earth) {
  const GeocentricSun sun = geocentricSun(instant, earth);
  SolarCoordinates result;
  result.right_ascension = Angle::degrees(sun.alpha);
  result.declination = Angle::degrees(sun.delta);
  result.apparent_sidereal_time = Angle::degrees(sun.nu);
  result.apparent_longitude = Angle::degrees(sun.lambda);
  result.obliquity = Angle::degrees(sun.nutation.true_obliquity_deg);
  result.distance_au = sun.earth.distance_au;
  result.equation_of_time_s = sun.eot_min * 60.0;
  return result;
}

}  // namespace sunlit::astronomy
