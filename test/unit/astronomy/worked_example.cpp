/// The worked example of Reda & Andreas (2008), Table A5.1: every intermediate result, each to the digits
/// printed there.
#include <gtest/gtest.h>

#include "astronomy/geocentric_sun.h"
#include "sunlit/astronomy/civil_time.h"
#include "sunlit/astronomy/refraction.h"
#include "sunlit/astronomy/sun_position.h"

namespace sunlit::astronomy {
namespace {

/// Half a unit of the last printed digit, and as much again for the rounding of the printed intermediates.
constexpr double kSixDigits = 1e-6;
constexpr double kTenDigits = 1e-10;

class WorkedExample : public ::testing::Test {
 protected:
  const Instant instant = instantOf({2003, 10, 17, 12, 30, 30.0, -7.0});
  const EarthRotation earth{0.0, 67.0};
  const Site site{Angle::degrees(39.742476), Angle::degrees(-105.1786), 1830.14};
  const Air air{820.0, 11.0, Angle::degrees(0.5667)};
  const GeocentricSun geocentric = geocentricSun(instant, earth);
  const SolarCoordinates coordinates = solarCoordinates(instant, earth);
  const SunPosition sun = sunPosition(coordinates, site, air);
};

TEST_F(WorkedExample, TimeArguments) {
  EXPECT_NEAR(geocentric.times.jd(), 2452930.312847, kSixDigits);
  EXPECT_NEAR(geocentric.times.jde(), 2452930.313623, kSixDigits);
  // Printed to 15 digits, but made from the JD of six decimals: half of 1e-6 days, in centuries and
  // millennia.
  EXPECT_NEAR(geocentric.times.jce, 0.037927819916852, 0.5e-6 / 36525.0);
  EXPECT_NEAR(geocentric.times.jme, 0.003792781991685, 0.5e-6 / 365250.0);
}

TEST_F(WorkedExample, HeliocentricEarth) {
  EXPECT_NEAR(geocentric.earth.longitude_deg, 24.0182616917, kTenDigits);
  EXPECT_NEAR(geocentric.earth.latitude_deg, -0.0001011219, kTenDigits);
  EXPECT_NEAR(geocentric.earth.distance_au, 0.9965422974, kTenDigits);
  EXPECT_NEAR(geocentric.theta, 204.0182616917, kTenDigits);
  EXPECT_NEAR(geocentric.beta, 0.0001011219, kTenDigits);
}

TEST_F(WorkedExample, NutationAndObliquity) {
  const double expected[] = {17185.861179, 1722.893218, 18234.075703, 18420.071012, 51.686951};
  for (int i = 0; i < 5; ++i) {
    SCOPED_TRACE("X" + std::to_string(i));
    EXPECT_NEAR(geocentric.nutation.x_deg[static_cast<std::size_t>(i)], expected[i], kSixDigits);
  }
  EXPECT_NEAR(geocentric.nutation.longitude_deg, -0.00399840, 1e-8);
  EXPECT_NEAR(geocentric.nutation.obliquity_deg, 0.00166657, 1e-8);
  EXPECT_NEAR(geocentric.nutation.mean_obliquity_arcsec, 84379.672625, kSixDigits);
  EXPECT_NEAR(geocentric.nutation.true_obliquity_deg, 23.440465, kSixDigits);
}

TEST_F(WorkedExample, GeocentricSun) {
  EXPECT_NEAR(geocentric.dtau, -0.005711, kSixDigits);
  EXPECT_NEAR(geocentric.lambda, 204.0085519281, kTenDigits);
  EXPECT_NEAR(geocentric.nu0, 318.515579, kSixDigits);
  EXPECT_NEAR(geocentric.nu, 318.511910, kSixDigits);
  EXPECT_NEAR(geocentric.alpha, 202.227408, kSixDigits);
  EXPECT_NEAR(geocentric.delta, -9.31434, 1e-5);
  EXPECT_NEAR(geocentric.eot_min, 14.6415, 1e-4);
}

TEST_F(WorkedExample, CoordinatesAreThoseOfTheGeocentricSun) {
  // Twice through degrees and radians: a few units of the last place.
  EXPECT_NEAR(coordinates.right_ascension.deg(), geocentric.alpha, 1e-12);
  EXPECT_NEAR(coordinates.declination.deg(), geocentric.delta, 1e-12);
  EXPECT_NEAR(coordinates.apparent_sidereal_time.deg(), geocentric.nu, 1e-12);
  EXPECT_NEAR(coordinates.apparent_longitude.deg(), geocentric.lambda, 1e-12);
  EXPECT_NEAR(coordinates.obliquity.deg(), geocentric.nutation.true_obliquity_deg, 1e-12);
  EXPECT_EQ(coordinates.distance_au, geocentric.earth.distance_au);
  EXPECT_EQ(coordinates.equation_of_time_s, geocentric.eot_min * 60.0);
}

TEST_F(WorkedExample, Parallax) {
  const double hour_angle_deg = geocentric.nu + site.longitude.deg() - geocentric.alpha;
  EXPECT_NEAR(hour_angle_deg, 11.105902, kSixDigits);
  EXPECT_NEAR(8.794 / (3600.0 * coordinates.distance_au), 0.002451, kSixDigits);
  EXPECT_NEAR(sun.right_ascension.deg() - geocentric.alpha, -0.000369, kSixDigits);
  EXPECT_NEAR(sun.right_ascension.deg(), 202.22704, 1e-5);
  EXPECT_NEAR(sun.declination.deg(), -9.316179, kSixDigits);
  EXPECT_NEAR(sun.hour_angle.deg(), 11.10627, 1e-5);
}

TEST_F(WorkedExample, TopocentricSun) {
  EXPECT_NEAR(sun.elevation_geometric.deg(), 39.872046, kSixDigits);
  EXPECT_NEAR(refraction(sun.elevation_geometric, air).deg(), 0.016332, kSixDigits);
  EXPECT_NEAR(sun.elevation.deg(), 39.888378, kSixDigits);
  EXPECT_NEAR(sun.zenith().deg(), 50.111622, kSixDigits);
  EXPECT_NEAR(sun.azimuth.deg(), 194.340241, kSixDigits);
  EXPECT_NEAR(incidence(sun, {Angle::degrees(30.0), Angle::degrees(-10.0)}).deg(), 25.187000, kSixDigits);
}

}  // namespace
}  // namespace sunlit::astronomy
