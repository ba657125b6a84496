#include "sunlit/astronomy/sun_position.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sunlit/astronomy/civil_time.h"

namespace sunlit::astronomy {
namespace {

constexpr Air kAir;
const Site kTrack{Angle::degrees(55.792115), Angle::degrees(49.122254), 90.0};
const EarthRotation kEarth{0.0, 69.184};

SunPosition onFirstOfJuly(int hour) {
  return sunPosition(instantOf({2024, 7, 1, hour, 0, 0.0, 3.0}), kEarth, kTrack, kAir);
}

TEST(SunPosition, TheExperimentsMorningIsInTheEastItsEveningInTheWest) {
  EXPECT_GT(onFirstOfJuly(4).elevation.deg(), 0.0);
  EXPECT_NEAR(onFirstOfJuly(4).azimuth.deg(), 55.0, 10.0);
  EXPECT_NEAR(onFirstOfJuly(12).azimuth.deg(), 180.0, 10.0);
  // Summer solstice ten days ago: 90 − latitude + 23.1.
  EXPECT_NEAR(onFirstOfJuly(12).elevation.deg(), 57.3, 0.2);
  EXPECT_NEAR(onFirstOfJuly(20).azimuth.deg(), 310.0, 10.0);
  EXPECT_GT(onFirstOfJuly(20).elevation.deg(), 0.0);
  EXPECT_LT(onFirstOfJuly(20).elevation.deg(), onFirstOfJuly(4).elevation.deg());
}

TEST(SunPosition, ManyPlacesAtOnceGetTheSameBitsAsOneByOne) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> latitude(-90.0, 90.0);
  std::uniform_real_distribution<double> longitude(-180.0, 180.0);
  std::vector<Site> sites;
  for (int i = 0; i < 1000; ++i) {
    sites.push_back({Angle::degrees(latitude(random)), Angle::degrees(longitude(random)), 100.0});
  }
  const Instant instant = instantOf({2024, 7, 1, 12, 0, 0.0, 3.0});
  const std::vector<SunPosition> batch = sunPositions(solarCoordinates(instant, kEarth), sites, kAir);
  ASSERT_EQ(batch.size(), sites.size());
  for (std::size_t i = 0; i < sites.size(); ++i) {
    const SunPosition single = sunPosition(instant, kEarth, sites[i], kAir);
    ASSERT_EQ(batch[i].azimuth.rad(), single.azimuth.rad());
    ASSERT_EQ(batch[i].elevation.rad(), single.elevation.rad());
    ASSERT_EQ(batch[i].declination.rad(), single.declination.rad());
  }
}

TEST(SunPosition, AtThePolesTheElevationIsTheDeclination) {
  const SolarCoordinates sun = solarCoordinates(instantOf({2024, 5, 1, 7, 0, 0.0, 0.0}), kEarth);
  const SunPosition north = sunPosition(sun, {Angle::degrees(90.0), Angle::degrees(20.0), 0.0}, kAir);
  const SunPosition south = sunPosition(sun, {Angle::degrees(-90.0), Angle::degrees(20.0), 0.0}, kAir);
  EXPECT_NEAR(north.elevation_geometric.deg(), north.declination.deg(), 1e-9);
  EXPECT_NEAR(south.elevation_geometric.deg(), -south.declination.deg(), 1e-9);
  // Parallax lowers the sun by 8.8″ · cos δ on either side.
  EXPECT_NEAR(north.elevation_geometric.deg(), sun.declination.deg() - 0.00236, 1e-4);
}

TEST(SunPosition, DirectionPointsTowardsTheApparentSun) {
  const SunPosition sun = onFirstOfJuly(20);
  const Eigen::Vector3d direction = sun.direction().vector();
  EXPECT_NEAR(direction.z(), sin(sun.elevation), 1e-15);
  EXPECT_LT(direction.x(), 0.0) << "west";
  EXPECT_GT(direction.y(), 0.0) << "north";
  EXPECT_NEAR(sun.zenith().deg() + sun.elevation.deg(), 90.0, 1e-12);
  EXPECT_GT(sun.elevation.deg(), sun.elevation_geometric.deg());
}

TEST(SunPosition, HourAngleIsZeroAtNoonAndGrowsWestward) {
  EXPECT_LT(onFirstOfJuly(4).hour_angle.deg(), -90.0);
  EXPECT_GT(onFirstOfJuly(20).hour_angle.deg(), 90.0);
  EXPECT_LE(onFirstOfJuly(20).hour_angle.deg(), 180.0);
}

TEST(SunPosition, Delta_ut1TurnsTheEarth) {
  // 0.9 s of rotation are 15.04″ · 0.9 on the equator of the sky.
  const Instant noon = instantOf({2024, 7, 1, 12, 0, 0.0, 3.0});
  const SunPosition later = sunPosition(noon, {0.9, 69.184 - 0.9}, kTrack, kAir);
  const SunPosition now = sunPosition(noon, kEarth, kTrack, kAir);
  EXPECT_NEAR((later.hour_angle - now.hour_angle).deg(), 0.9 * 15.04107 / 3600.0, 1e-6);
}

TEST(SunPosition, AnErrorOfDeltaTOfSixSecondsIsHarmless) {
  const Instant noon = instantOf({2024, 7, 1, 12, 0, 0.0, 3.0});
  const SunPosition given = sunPosition(noon, {0.0, 69.184}, kTrack, kAir);
  const SunPosition wrong = sunPosition(noon, {0.0, 75.184}, kTrack, kAir);
  EXPECT_NEAR((given.azimuth.angle() - wrong.azimuth.angle()).deg(), 0.0, 2e-4);
}

TEST(Incidence, OnALevelSurfaceIsTheZenithAngle) {
  for (const int hour : {4, 12, 20}) {
    const SunPosition sun = onFirstOfJuly(hour);
    // The arc cosine of nearly 1 would cost digits, but the sun stays far from the zenith here.
    EXPECT_NEAR(incidence(sun, {Angle(), Angle::degrees(77.0)}).deg(), sun.zenith().deg(), 1e-9);
  }
}

TEST(Incidence, IsTheAngleBetweenSunAndNormal) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(-180.0, 180.0);
  for (int i = 0; i < 1000; ++i) {
    const SunPosition sun = onFirstOfJuly(i % 24);
    const Surface surface{Angle::degrees(std::abs(any(random))), Angle::degrees(any(random))};
    // Azimuth from south, positive west: compass azimuth less 180°.
    const Direction normal(Azimuth(surface.azm_rotation + Angle::degrees(180.0)),
                           Angle::degrees(90.0) - surface.slope);
    const double expected = std::acos(normal.vector().dot(sun.direction().vector()));
    ASSERT_NEAR(incidence(sun, surface).rad(), expected, 1e-7);  // arc cosines near 0 and 180°
  }
}

TEST(EquationOfTime, ExtremesOfTheYear) {
  // Almanacs of about 2000: −14 min 15 s on 11 February, +16 min 25 s on 3 November, to 1 s or so from year
  // to year.
  double low = 0.0;
  double high = 0.0;
  for (int day = 0; day < 366; ++day) {
    const double eot_s =
        solarCoordinates(instantOf({2000, 1, 1, 0, 0, 0.0, 0.0}).plusSeconds(day * 86400.0), kEarth)
            .equation_of_time_s;
    low = std::min(low, eot_s);
    high = std::max(high, eot_s);
  }
  EXPECT_NEAR(low, -855.0, 1.5);
  EXPECT_NEAR(high, 985.0, 1.5);
}

TEST(EquationOfTime, IsApparentMinusMeanSolarTime) {
  // At the prime meridian, mean solar time is UT1, and apparent solar time is the hour angle plus 12 h.
  for (int month = 1; month <= 12; ++month) {
    const SolarCoordinates sun = solarCoordinates(instantOf({2024, month, 1, 12, 0, 0.0, 0.0}), kEarth);
    const double hour_angle_deg = (sun.apparent_sidereal_time - sun.right_ascension).deg();
    // To 1 s: the convention takes M in TT, the Earth turns in UT1.
    EXPECT_NEAR(std::remainder(hour_angle_deg, 360.0) * 240.0, sun.equation_of_time_s, 1.0);
  }
}

TEST(SolarCoordinates, HoldAtTheEndsOfTheSupportedYears) {
  const EarthRotation automatic;
  for (const int year : {-2000, -500, 1000, 3000, 6000}) {
    for (int month = 1; month <= 12; ++month) {
      const SolarCoordinates sun = solarCoordinates(instantOf({year, month, 15, 12, 0, 0.0, 0.0}), automatic);
      // The orbit's eccentricity was 0.0182 in −2000 and will be 0.0150 in 6000.
      EXPECT_NEAR(sun.distance_au, 1.0, 0.0185);
      EXPECT_LE(std::abs(sun.declination.deg()), sun.obliquity.deg() + 1e-3);
      EXPECT_NEAR(sun.obliquity.deg(), 23.44, 0.53);
      EXPECT_LT(std::abs(sun.equation_of_time_s), 1200.0);
    }
  }
}

}  // namespace
}  // namespace sunlit::astronomy
