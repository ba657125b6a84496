/// The sun against ERFA (Essential Routines for Fundamental Astronomy), which shares nothing with SPA:
/// VSOP2000 ephemeris, IAU 2006/2000A precession and nutation, vectors instead of series of angles.
#include <erfa.h>
#include <erfam.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "sunlit/astronomy/civil_time.h"
#include "sunlit/astronomy/delta_t.h"
#include "sunlit/astronomy/sun_position.h"

namespace sunlit::astronomy {
namespace {

constexpr double kAllowedDeg = 0.0003;  // what Reda & Andreas claim for SPA
constexpr double kSpeedOfLight_au_per_day = 173.1446326742403;

/// Towards the sun in the true equator and equinox of date, as seen by an observer on the Earth, and their
/// hour angle.
struct Truth {
  Direction direction;
  double right_ascension_rad;
  double declination_rad;
};

Truth truth(const Instant& ut1, double delta_t_s, const Site& site) {
  const double day = static_cast<double>(ut1.julianDay());
  const double fraction = ut1.dayFraction();
  const double tt_fraction = fraction + delta_t_s / 86400.0;

  double heliocentric[2][3], barycentric[2][3];
  EXPECT_EQ(eraEpv00(day, tt_fraction, heliocentric, barycentric), 0);
  double natural[3], velocity[3], distance_au = 0.0;
  double towards_sun[3] = {-heliocentric[0][0], -heliocentric[0][1], -heliocentric[0][2]};
  eraPn(towards_sun, &distance_au, natural);
  for (int i = 0; i < 3; ++i) velocity[i] = barycentric[1][i] / kSpeedOfLight_au_per_day;
  const double speed2 = velocity[0] * velocity[0] + velocity[1] * velocity[1] + velocity[2] * velocity[2];
  double proper[3];
  eraAb(natural, velocity, distance_au, std::sqrt(1.0 - speed2), proper);

  double of_date_from_gcrs[3][3], of_date[3];
  eraPnm06a(day, tt_fraction, of_date_from_gcrs);
  eraRxp(of_date_from_gcrs, proper, of_date);

  // Parallax and diurnal aberration.
  const double sidereal_time = eraGst06a(day, fraction, day, tt_fraction);
  double observer[2][3];
  eraPvtob(site.longitude.rad(), site.latitude.rad(), site.elevation_m, 0.0, 0.0, 0.0, sidereal_time,
           observer);
  double topocentric[3];
  for (int i = 0; i < 3; ++i) {
    topocentric[i] =
        distance_au * of_date[i] - observer[0][i] / ERFA_DAU + distance_au * observer[1][i] / ERFA_CMPS;
  }
  double right_ascension, declination, azimuth, elevation;
  eraC2s(topocentric, &right_ascension, &declination);
  eraHd2ae(sidereal_time + site.longitude.rad() - right_ascension, declination, site.latitude.rad(), &azimuth,
           &elevation);
  return {Direction(Azimuth(Angle::radians(azimuth)), Angle::radians(elevation)), right_ascension,
          declination};
}

double between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) / kRadPerDeg;
}

TEST(AgainstErfa, AtRandomPlacesAndTimesOfTwoCenturies) {
  std::mt19937_64 random(4);
  std::uniform_int_distribution<std::int64_t> day(julianDayNumber(1900, 1, 1), julianDayNumber(2099, 12, 31));
  std::uniform_int_distribution<std::int64_t> nanosecond(0, Instant::kNanosecondsPerDay - 1);
  std::uniform_real_distribution<double> sine(-1.0, 1.0), longitude(-180.0, 180.0),
      elevation(-500.0, 12000.0);
  constexpr Air kNoAir{0.0, 0.0, Angle()};
  double largest = 0.0, largest_ra = 0.0, largest_declination = 0.0, sum_of_squares = 0.0;
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i) {
    const Instant ut1(day(random), nanosecond(random));
    const Site site{Angle::radians(std::asin(sine(random))), Angle::degrees(longitude(random)),
                    elevation(random)};
    const double delta_t_s = deltaT(ut1);
    const SunPosition ours = sunPosition(ut1, {0.0, delta_t_s}, site, kNoAir);
    const Truth expected = truth(ut1, delta_t_s, site);
    const Direction geometric(ours.azimuth, ours.elevation_geometric);
    const double error = between(geometric.vector(), expected.direction.vector());
    ASSERT_LE(error, kAllowedDeg) << "JD " << ut1.julianDate() << ", latitude " << site.latitude.deg();
    largest = std::max(largest, error);
    sum_of_squares += error * error;
    largest_declination = std::max(largest_declination,
                                   std::abs(ours.declination.rad() - expected.declination_rad) / kRadPerDeg);
    // As an arc on the sky, like the others.
    const double ra_error =
        std::remainder(ours.right_ascension.rad() - expected.right_ascension_rad, 2.0 * kPi);
    largest_ra = std::max(largest_ra, std::abs(ra_error) * cos(ours.declination) / kRadPerDeg);
  }
  EXPECT_LE(largest_ra, kAllowedDeg);
  EXPECT_LE(largest_declination, kAllowedDeg);
  RecordProperty("largest_error_deg", std::to_string(largest));
  std::printf(
      "against ERFA, 1900 to 2100, %d samples: largest error %.6f deg, rms %.6f deg; right ascension %.6f "
      "deg, "
      "declination %.6f deg\n",
      kSamples, largest, std::sqrt(sum_of_squares / kSamples), largest_ra, largest_declination);
}

}  // namespace
}  // namespace sunlit::astronomy
