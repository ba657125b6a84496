/// The moon against published examples and an observed eclipse.
#include "sunlit/astronomy/moon_position.h"

#include <erfa.h>
#include <erfam.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "sunlit/astronomy/civil_time.h"
#include "sunlit/astronomy/refraction.h"
#include "sunlit/astronomy/sun_position.h"

namespace sunlit::astronomy {
namespace {

constexpr Air kNoAir{0.0, 0.0, Angle()};

Angle between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return Angle::radians(std::atan2(a.cross(b).norm(), a.dot(b)));
}

/// 12 April 1992, 0 h TD, of Meeus, examples 47.a and 48.a.
struct MeeusExample : testing::Test {
  const Instant instant = instantOf({1992, 4, 12, 0, 0, 0.0, 0.0});
  const EarthRotation earth{0.0, 0.0};  // the date is TD already
  const LunarCoordinates moon = lunarCoordinates(instant, earth);
  const SolarCoordinates sun = solarCoordinates(instant, earth);
};

TEST_F(MeeusExample, PlaceIsThatOf47a) {
  // ERFA has newer mean elements than Meeus: up to 1″ and 1 km.
  constexpr double kAllowedDeg = 1.0 / 3600.0;
  EXPECT_NEAR(moon.right_ascension.deg(), 134.688470, kAllowedDeg);
  EXPECT_NEAR(moon.declination.deg(), 13.768368, kAllowedDeg);
  EXPECT_NEAR(moon.distance_m, 368409.7e3, 1e3);

  const Angle e = sun.obliquity;
  const double longitude = std::atan2(sin(moon.right_ascension) * cos(e) + tan(moon.declination) * sin(e),
                                      cos(moon.right_ascension));
  const double latitude =
      std::asin(sin(moon.declination) * cos(e) - cos(moon.declination) * sin(e) * sin(moon.right_ascension));
  EXPECT_NEAR(longitude / kRadPerDeg, 133.162655 + 0.004610, kAllowedDeg);  // apparent: with his nutation
  EXPECT_NEAR(latitude / kRadPerDeg, -3.229126, kAllowedDeg);
}

TEST_F(MeeusExample, LightIsThatOf48a) {
  // An observer at the centre of the Earth.
  const Site centre{Angle(), Angle(), -6378140.0};
  const MoonPosition seen = moonPosition(moon, sun, centre, kNoAir);
  EXPECT_NEAR(seen.distance_m, moon.distance_m, 1e-3);
  // All digits that he prints, and the 1″ by which the place may differ.
  EXPECT_NEAR(seen.phase_angle.deg(), 69.0756, 4e-4);
  EXPECT_NEAR(seen.illuminated_fraction, 0.6786, 5e-5);
  EXPECT_NEAR(seen.bright_limb.deg(), 285.0, 0.05);
}

/// How far the rim of the sun is from being covered by the moon in Dallas, rad; below zero in totality.
double uncoveredAt(const Instant& instant) {
  const Site dallas{Angle::degrees(32.7767), Angle::degrees(-96.7970), 130.0};
  const EarthRotation earth{0.0, 69.2};
  const SunPosition sun = sunPosition(instant, earth, dallas, kNoAir);
  const MoonPosition moon = moonPosition(instant, earth, dallas, kNoAir);
  const double sun_radius = 959.63 / 3600.0 * kRadPerDeg / solarCoordinates(instant, earth).distance_au;
  return between(sun.direction().vector(), moon.direction().vector()).rad() + sun_radius -
         moon.angularRadius().rad();
}

TEST(MoonPosition, CoveredTheSunInDallasOn8April2024) {
  // Totality there was from 18:40:42 to 18:44:33 UTC. The moon's rim is rough by 2″, and it gains 0.3″ a
  // second or less on the sun: 10 s.
  const Instant begin = instantOf({2024, 4, 8, 18, 40, 42.0, 0.0});
  const Instant end = instantOf({2024, 4, 8, 18, 44, 33.0, 0.0});
  EXPECT_GT(uncoveredAt(begin.plusSeconds(-10.0)), 0.0);
  EXPECT_LT(uncoveredAt(begin.plusSeconds(10.0)), 0.0);
  EXPECT_LT(uncoveredAt(end.plusSeconds(-10.0)), 0.0);
  EXPECT_GT(uncoveredAt(end.plusSeconds(10.0)), 0.0);
}

TEST(MoonPosition, IsFullInTheEarthsShadowOn8November2022) {
  // Greatest eclipse 10:59:11 UTC; seen from where the moon stood in the zenith then.
  const Instant instant = instantOf({2022, 11, 8, 10, 59, 11.0, 0.0});
  const EarthRotation earth{0.0, 69.2};
  const Site hawaii{Angle::degrees(16.9), Angle::degrees(-168.9), 0.0};
  const MoonPosition moon = moonPosition(instant, earth, hawaii, kNoAir);
  EXPECT_GT(moon.elevation.deg(), 89.0);
  // The axis of the shadow passed 0.257 Earth radii from the centre, which is 0.24° as seen from the moon;
  // the observer stands up to one radius, 0.94°, from there.
  EXPECT_LT(moon.phase_angle.deg(), 1.2);
  EXPECT_GT(moon.illuminated_fraction, 0.9998);
}

TEST(MoonPosition, PhaseGoesRoundInAMonth) {
  const EarthRotation earth{0.0, 69.2};
  const Site site{Angle::degrees(55.792115), Angle::degrees(49.122254), 90.0};
  // U.S. Naval Observatory: new 5 July 22:57, first quarter 13 July 22:49, full 21 July 10:17, last quarter
  // 28 July 02:52 UT, 2024. At the quarters the geocentric elongation is 90°, so the phase angle at the moon
  // is 0.15° less; parallax adds up to 1°, the latitude of the moon 5° at new and full.
  EXPECT_GT(moonPosition(instantOf({2024, 7, 5, 22, 57, 0.0, 0.0}), earth, site, kNoAir).phase_angle.deg(),
            173.0);
  EXPECT_LT(moonPosition(instantOf({2024, 7, 21, 10, 17, 0.0, 0.0}), earth, site, kNoAir).phase_angle.deg(),
            6.5);
  for (const CivilDateTime& quarter :
       {CivilDateTime{2024, 7, 13, 22, 49, 0.0, 0.0}, CivilDateTime{2024, 7, 28, 2, 52, 0.0, 0.0}}) {
    const MoonPosition moon = moonPosition(instantOf(quarter), earth, site, kNoAir);
    EXPECT_NEAR(moon.phase_angle.deg(), 89.85, 1.2);
    EXPECT_NEAR(moon.illuminated_fraction, 0.5, 0.011);
  }
  // Lit from the west while it waxes, from the east while it wanes.
  const auto limb = [&](int day) {
    return moonPosition(instantOf({2024, 7, day, 12, 0, 0.0, 0.0}), earth, site, kNoAir).bright_limb.deg();
  };
  EXPECT_NEAR(limb(13), 270.0, 45.0);
  EXPECT_NEAR(limb(28), 90.0, 45.0);
}

TEST(MoonPosition, RefractionIsTheSuns) {
  const EarthRotation earth{0.0, 69.2};
  const Site site{Angle::degrees(55.792115), Angle::degrees(49.122254), 90.0};
  const Instant instant = instantOf({2024, 7, 21, 0, 30, 0.0, 3.0});
  const MoonPosition bare = moonPosition(instant, earth, site, kNoAir);
  const MoonPosition lifted = moonPosition(instant, earth, site, Air());
  EXPECT_EQ(lifted.elevation_geometric, bare.elevation);
  EXPECT_EQ(lifted.elevation, bare.elevation + refraction(bare.elevation, Air()));
  EXPECT_EQ(lifted.azimuth.rad(), bare.azimuth.rad());
  EXPECT_GT(lifted.elevation, bare.elevation);
}

TEST(MoonPosition, MovesWithoutJumpsThroughRiseAndSet) {
  const EarthRotation earth{0.0, 69.2};
  const Site site{Angle::degrees(55.792115), Angle::degrees(49.122254), 90.0};
  Instant instant = instantOf({2024, 7, 21, 12, 0, 0.0, 3.0});
  Direction last = moonPosition(instant, earth, site, Air()).direction();
  for (int step = 0; step < 8640; ++step) {
    instant = instant.plusSeconds(10.0);
    const Direction now = moonPosition(instant, earth, site, Air()).direction();
    // 10 s of the sky's turning are 0.042°; where refraction fades out below the horizon, half as much again.
    ASSERT_LT(between(last.vector(), now.vector()).deg(), 0.063) << "step " << step;
    ASSERT_GT(between(last.vector(), now.vector()).deg(), 0.02) << "step " << step;
    last = now;
  }
}

TEST(MoonPosition, StaysNearTheEarthInAllYears) {
  const Site site{Angle::degrees(-33.9), Angle::degrees(18.4), 0.0};
  for (int year = -2000; year <= 6000; year += 100) {
    for (int day = 1; day <= 28; day += 9) {
      const Instant instant = instantOf({year, 5, day, 7, 0, 0.0, 0.0});
      const MoonPosition moon = moonPosition(instant, EarthRotation(), site, kNoAir);
      // Meeus, p. 343: 356,371 to 406,720 km over 1500 to 2500; one Earth radius for the observer, some for
      // other years.
      ASSERT_GT(moon.distance_m, 349.5e6) << year;
      ASSERT_LT(moon.distance_m, 413.5e6) << year;
      const SolarCoordinates sun = solarCoordinates(instant, EarthRotation());
      // The orbit is inclined by 5.3° at the most to the ecliptic; parallax 1°.
      const double latitude =
          std::asin(sin(moon.declination) * cos(sun.obliquity) -
                    cos(moon.declination) * sin(sun.obliquity) * sin(moon.right_ascension));
      ASSERT_LT(std::abs(latitude) / kRadPerDeg, 6.4) << year;
    }
  }
}

TEST(MoonPosition, DistanceIsThatFromTheEllipsoid) {
  const Instant instant = instantOf({2024, 7, 21, 10, 17, 0.0, 0.0});
  const EarthRotation earth{0.0, 69.2};
  const LunarCoordinates moon = lunarCoordinates(instant, earth);
  const SolarCoordinates sun = solarCoordinates(instant, earth);
  for (const Site& site : {Site{Angle::degrees(55.792115), Angle::degrees(49.122254), 90.0},
                           Site{Angle::degrees(-89.9), Angle::degrees(10.0), 2800.0}}) {
    double observer[2][3];
    eraPvtob(site.longitude.rad(), site.latitude.rad(), site.elevation_m, 0.0, 0.0, 0.0,
             sun.apparent_sidereal_time.rad(), observer);
    double centre[3], towards[3];
    eraS2p(moon.right_ascension.rad(), moon.declination.rad(), moon.distance_m, centre);
    eraPmp(centre, observer[0], towards);
    // SPA's Earth is 3 m larger than that of WGS 84.
    EXPECT_NEAR(moonPosition(moon, sun, site, kNoAir).distance_m, eraPm(towards), 5.0);
  }
}

}  // namespace
}  // namespace sunlit::astronomy
