/// The moon against ERFA's own, and its way from a body to an observer. Built where ERFA has a moon.
#include <erfa.h>
#include <erfam.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "astronomy/moon_series.h"
#include "astronomy/nutation.h"
#include "sunlit/astronomy/civil_time.h"
#include "sunlit/astronomy/delta_t.h"
#include "sunlit/astronomy/moon_position.h"
#include "sunlit/astronomy/sun_position.h"

namespace sunlit::astronomy {
namespace {

constexpr Air kNoAir{0.0, 0.0, Angle()};
constexpr double kArcsecPerRad = 3600.0 / kRadPerDeg;

Angle between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return Angle::radians(std::atan2(a.cross(b).norm(), a.dot(b)));
}

/// Towards the moon in `map`, through the barycentre of the solar system: light leaves the moon where it was,
/// arrives at the moving observer, and its direction is aberrated by all of his motion.
Eigen::Vector3d throughTheBarycentre(const Instant& ut1, double delta_t_s, const Site& site) {
  const double day = static_cast<double>(ut1.julianDay());
  const double fraction = ut1.dayFraction();
  const double tt_fraction = fraction + delta_t_s / ERFA_DAYSEC;

  double heliocentric[2][3], earth[2][3], matrix[3][3], x, y;
  eraEpv00(day, tt_fraction, heliocentric, earth);
  eraPnm06a(day, tt_fraction, matrix);
  eraBpn2xy(matrix, &x, &y);
  eraASTROM astrom;
  eraApco(day, tt_fraction, earth, heliocentric[0], x, y, eraS06(day, tt_fraction, x, y),
          eraEra00(day, fraction), site.longitude.rad(), site.latitude.rad(), site.elevation_m, 0.0, 0.0, 0.0,
          0.0, 0.0, &astrom);

  double light_time_days = 1.3 / ERFA_DAYSEC, towards[3], moon[2][3];
  for (int i = 0; i < 4; ++i) {
    eraEpv00(day, tt_fraction - light_time_days, heliocentric, earth);
    eraMoon98(day, tt_fraction - light_time_days, moon);
    for (int k = 0; k < 3; ++k) towards[k] = earth[0][k] + moon[0][k] - astrom.eb[k];
    light_time_days = eraPm(towards) * ERFA_AULT / ERFA_DAYSEC;
  }
  double distance_au, natural[3], proper[3], intermediate[3];
  eraPn(towards, &distance_au, natural);
  eraAb(natural, astrom.v, astrom.em, astrom.bm1, proper);
  eraRxp(astrom.bpn, proper, intermediate);
  double right_ascension, declination, azimuth, zenith, hour_angle, observed_declination, observed_ra;
  eraC2s(intermediate, &right_ascension, &declination);
  eraAtioq(right_ascension, declination, &astrom, &azimuth, &zenith, &hour_angle, &observed_declination,
           &observed_ra);
  return Direction(Azimuth(Angle::radians(azimuth)), Angle::degrees(90.0) - Angle::radians(zenith)).vector();
}

TEST(MoonPosition, AgreesWithTheWayThroughTheBarycentre) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<std::int64_t> day(julianDayNumber(1950, 1, 1), julianDayNumber(2049, 12, 31));
  std::uniform_int_distribution<std::int64_t> nanosecond(0, Instant::kNanosecondsPerDay - 1);
  std::uniform_real_distribution<double> sine(-1.0, 1.0), longitude(-180.0, 180.0),
      elevation(-500.0, 12000.0);
  double largest = 0.0, sum_of_squares = 0.0;
  constexpr int kSamples = 3000;
  for (int i = 0; i < kSamples; ++i) {
    const Instant ut1(day(random), nanosecond(random));
    const Site site{Angle::radians(std::asin(sine(random))), Angle::degrees(longitude(random)),
                    elevation(random)};
    const double delta_t_s = deltaT(ut1);
    const MoonPosition moon = moonPosition(ut1, {0.0, delta_t_s}, site, kNoAir);
    const double error =
        between(moon.direction().vector(), throughTheBarycentre(ut1, delta_t_s, site)).rad() * kArcsecPerRad;
    // 0.32″ of diurnal aberration, which ours leaves out, and SPA's nutation and sidereal time.
    ASSERT_LT(error, 0.6) << "JD " << ut1.julianDate() << ", latitude " << site.latitude.deg();
    largest = std::max(largest, error);
    sum_of_squares += error * error;
  }
  std::printf("moon, 1950 to 2050, %d samples: largest difference %.3f arcsec, rms %.3f arcsec\n", kSamples,
              largest, std::sqrt(sum_of_squares / kSamples));
}

/// Ours, in the true equator and equinox of date, m, by the obliquity of ERFA.
Eigen::Vector3d bySeries(double jce) {
  const EclipticMoon moon = moonByMeeus(jce);
  const Nutation wobble = nutation(jce);
  double direction[3];
  eraS2c((moon.longitude_deg + wobble.longitude_deg) * kRadPerDeg, moon.latitude_deg * kRadPerDeg, direction);
  const double obliquity = eraObl06(ERFA_DJ00, jce * 36525.0) + wobble.obliquity_deg * kRadPerDeg;
  return moon.distance_m * (Eigen::AngleAxisd(obliquity, Eigen::Vector3d::UnitX()) *
                            Eigen::Vector3d(direction[0], direction[1], direction[2]));
}

TEST(MoonSeries, IsTheMoonOfErfa) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> day(-36525.0, 36525.0);
  double largest_arcsec = 0.0, largest_m = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const Instant instant(2451545, 0);
    const Instant then = instant.plusSeconds(day(random) * 86400.0);
    const LunarCoordinates erfa = lunarCoordinates(then, {0.0, 0.0});
    double direction[3];
    eraS2c(erfa.right_ascension.rad(), erfa.declination.rad(), direction);
    const Eigen::Vector3d ours = bySeries((then.julianDate() - 2451545.0) / 36525.0);
    const Eigen::Vector3d theirs(direction[0], direction[1], direction[2]);
    largest_arcsec = std::max(largest_arcsec, between(ours, theirs).rad() * kArcsecPerRad);
    largest_m = std::max(largest_m, std::abs(ours.norm() - erfa.distance_m));
  }
  std::printf("series against ERFA, 1900 to 2100: %.3f arcsec, %.0f m at the most\n", largest_arcsec,
              largest_m);
  EXPECT_LT(largest_arcsec, 0.2);
  EXPECT_LT(largest_m, 200.0);
}

}  // namespace
}  // namespace sunlit::astronomy
