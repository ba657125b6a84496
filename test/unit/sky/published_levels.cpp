/// Light of the day and of the night against published levels.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "directions.h"
#include "sunlit/sky/atmosphere.h"

namespace sunlit::sky {
namespace {

struct Piece {
  double lowest_deg;
  std::array<double, 4> coefficients;
};

/// log10 of the illuminance, lx, of level ground under a clear sky: polynomials in elevation / 90°, by piece.
double published_lx(const std::vector<Piece>& pieces, double elevation_deg) {
  for (const Piece& piece : pieces) {
    if (elevation_deg >= piece.lowest_deg) {
      const double x = elevation_deg / 90.0;
      const std::array<double, 4>& c = piece.coefficients;
      return std::pow(10.0, c[0] + x * (c[1] + x * (c[2] + x * c[3])));
    }
  }
  return 0.0;
}

/// Janiczek & DeYoung 1987, USNO Circular 171, of the sun (also Vallado, Fundamentals of Astrodynamics, table
/// 5-1); below −12° with the night's own light.
double sunAndSky_lx(double elevation_deg) {
  return published_lx({{20.0, {3.74, 3.97, -4.07, 1.47}},
                       {5.0, {3.05, 13.28, -45.98, 64.33}},
                       {-0.8, {2.88, 22.26, -207.64, 1034.30}},
                       {-5.0, {2.88, 21.81, -258.11, -858.36}},
                       {-12.0, {2.70, 12.17, -431.69, -1899.83}},
                       {-18.0, {13.84, 262.72, 1447.42, 2797.93}}},
                      elevation_deg);
}

/// The same, of the full moon at its mean distance.
double fullMoon_lx(double elevation_deg) {
  return published_lx({{20.0, {-1.95, 4.06, -4.24, 1.56}}, {5.0, {-2.58, 12.58, -42.58, 59.06}}},
                      elevation_deg);
}

/// Clear day of lighting practice (IES Calculation Procedures Committee 1984, J. IES 13, 381): the sun on a
/// plane facing it, and level ground.
struct ClearDay {
  explicit ClearDay(double elevation_deg) {
    const double sine = std::sin(elevation_deg * kRadPerDeg);
    sun_lx = 127500.0 * std::exp(-0.21 / sine);
    ground_lx = sun_lx * sine + 800.0 + 15500.0 * std::sqrt(sine);
  }
  double sun_lx, ground_lx;
};

double ground_lx(double elevation_deg, const NightSky& night = {}) {
  return usualAir().daylight({at(137.0, elevation_deg), 1.0}, night).groundIlluminance().luminance();
}

NightSky withMoon(double elevation_deg, double phase_angle_deg) {
  NightSky night;
  night.moon = MoonInSky{at(40.0, elevation_deg), std::nullopt, 384400e3, Angle::degrees(phase_angle_deg)};
  return night;
}

TEST(PublishedLevels, DayAndTwilight) {
  // Clear air differs by 15 % under a high sun: at 30° this curve is 14 % below ours, which is within 2 % of
  // the clear day below. Haze counts for more under a low one, and in twilight a degree of sun is a factor
  // of 3.
  const auto expect = [](double elevation_deg, double tolerance) {
    const double published = sunAndSky_lx(elevation_deg);
    EXPECT_NEAR(ground_lx(elevation_deg), published, tolerance * published) << elevation_deg;
  };
  for (const double elevation_deg : {90.0, 60.0, 30.0}) {
    expect(elevation_deg, 0.15);
  }
  for (const double elevation_deg : {10.0, 5.0, 2.0, 0.0, -0.8, -2.0, -4.0}) {
    expect(elevation_deg, 0.3);
  }
  for (const double elevation_deg : {-6.0, -9.0, -12.0}) {
    expect(elevation_deg, 0.5);
  }
}

TEST(PublishedLevels, TheTwilightsOfMeteorologists) {
  // Glossary of Meteorology (American Meteorological Society): what clear civil twilight begins and ends
  // with.
  EXPECT_GT(ground_lx(-0.83), 410.0);
  EXPECT_LT(ground_lx(-0.83), 585.0);
  EXPECT_GT(ground_lx(-6.0), 2.0);
  EXPECT_LT(ground_lx(-6.0), 3.5);
}

TEST(PublishedLevels, TheClearDayOfLightingPractice) {
  // By 5 % it is clearer days that differ, from 20° up; at 10° a curve in 1 / sin has lost the Earth's
  // roundness.
  for (const double elevation_deg : {90.0, 60.0, 30.0, 20.0, 10.0}) {
    const ClearDay published(elevation_deg);
    const Daylight light = usualAir().daylight({at(137.0, elevation_deg), 1.0});
    EXPECT_NEAR(light.sun().illuminance.luminance(), published.sun_lx, 0.05 * published.sun_lx)
        << elevation_deg;
    EXPECT_NEAR(light.groundIlluminance().luminance(), published.ground_lx, 0.05 * published.ground_lx)
        << elevation_deg;
  }
}

TEST(PublishedLevels, TheSettingSunIsARedDiscThatOneCanLookAt) {
  // 6e5 cd/m² is often quoted for the sun at the horizon, without a source; haze is worth a factor of 10
  // either way. It is far brighter than the sky beside it.
  for (const double elevation_deg : {0.5, 1.0}) {
    const Daylight light = usualAir().daylight({at(137.0, elevation_deg), 1.0});
    const DiscLight& sun = light.sun();
    const double disc = sun.illuminance.luminance() / (kPi * std::pow(sun.angular_radius.rad(), 2));
    EXPECT_GT(disc, 6e4) << elevation_deg;
    EXPECT_LT(disc, 6e6) << elevation_deg;
    EXPECT_GT(disc, 100.0 * light.skyLuminance(sun.towards.vector().cast<float>()).luminance())
        << elevation_deg;
    EXPECT_GT(sun.illuminance.value[0], 5.0F * sun.illuminance.value[1]) << elevation_deg;
  }
}

/// Patat et al. 2006 (A&A 455, 385): V of the zenith over Paranal, mag a square arc second, d the degrees of
/// the sun below −5°; 0 mag is 1.08e5 cd/m².
double zenithOverParanal(double elevation_deg) {
  const double d = -5.0 - elevation_deg;
  return 1.08e5 * std::pow(10.0, -0.4 * (11.84 + 1.518 * d - 0.057 * d * d));
}

double zenith(double elevation_deg) {
  return usualAir().daylight({at(137.0, elevation_deg), 1.0}).skyLuminance({0.0F, 0.0F, 1.0F}).luminance();
}

TEST(PublishedLevels, TheZenithFadesThroughTwilightAsMeasured) {
  // Their air is higher, clearer and has less ozone, which takes 60 % of the zenith's light: with 250
  // DU instead of 300 ours is at 0.83-1.02 of theirs, without that at 0.73-0.99. V is not quite luminance,
  // and the night under it varies: 30 %. The sky falls by a factor of 1,600 meanwhile.
  for (const double elevation_deg : {-6.0, -8.0, -10.0, -12.0, -14.0, -15.0}) {
    const double published = zenithOverParanal(elevation_deg);
    EXPECT_NEAR(zenith(elevation_deg), published, 0.3 * published) << elevation_deg;
  }
  // How fast the sun's part fades at the end, above the night: V = 21.6 (Patat 2003) at Paranal.
  const double night_there = 1.08e5 * std::pow(10.0, -0.4 * 21.6);
  const double published =
      (zenithOverParanal(-12.0) - night_there) / (zenithOverParanal(-15.0) - night_there);
  const double night = zenith(-40.0);
  EXPECT_NEAR((zenith(-12.0) - night) / (zenith(-15.0) - night), published, 0.2 * published);
}

TEST(PublishedLevels, DeepTwilightPassesIntoTheNight) {
  // Within a factor of 2: the airglow alone varies by that with the sun's activity. At −15° ours is 0.63 of
  // the published curve, which there has a shoulder that no sum of a fading twilight and a steady night has:
  // it falls by 0.29 dex a degree at −12°, 0.15 at −15°, and again 0.22 at −18°, where it ends.
  for (const double elevation_deg : {-15.0, -18.0}) {
    const double ratio = ground_lx(elevation_deg) / sunAndSky_lx(elevation_deg);
    EXPECT_GT(ratio, 0.5) << elevation_deg;
    EXPECT_LT(ratio, 2.0) << elevation_deg;
  }
  // A moonless night gives 1e-3 lx (Schlyter; Seidelmann 1992), the zenith 2e-4 cd/m², 21.8 mag a square
  // arc second.
  const Daylight night = usualAir().daylight({at(0.0, -40.0), 1.0});
  EXPECT_GT(night.groundIlluminance().luminance(), 0.5e-3F);
  EXPECT_LT(night.groundIlluminance().luminance(), 2e-3F);
  const float zenith = night.skyLuminance({0.0F, 0.0F, 1.0F}).luminance();
  EXPECT_GT(zenith, 1e-4F);
  EXPECT_LT(zenith, 4e-4F);
}

TEST(PublishedLevels, FullMoon) {
  const double dark_lx = ground_lx(-40.0);
  for (const double elevation_deg : {90.0, 60.0, 30.0, 10.0}) {
    const double published = fullMoon_lx(elevation_deg);
    const double moon_lx = ground_lx(-40.0, withMoon(elevation_deg, 0.0)) - dark_lx;
    // Two phase laws differ by 10 %, air by 15 %; to 10° this source's curve of the sun, too, falls by 25 %
    // more than the clear day's above.
    EXPECT_NEAR(moon_lx, published, (elevation_deg > 45.0 ? 0.25 : 0.45) * published) << elevation_deg;
  }
  // Sky under a full moon: 5e-3 cd/m² away from it, within a factor of 2.
  const Daylight night = usualAir().daylight({at(220.0, -40.0), 1.0}, withMoon(45.0, 0.0));
  const float sky = night.skyLuminance(at(220.0, 60.0).vector().cast<float>()).luminance();
  EXPECT_GT(sky, 2.5e-3F);
  EXPECT_LT(sky, 1e-2F);
}

TEST(PublishedLevels, AQuarterMoonIsElevenTimesDarkerThanAFullOne) {
  const double dark_lx = ground_lx(-40.0);
  const double full_lx = ground_lx(-40.0, withMoon(60.0, 0.0)) - dark_lx;
  const double quarter_lx = ground_lx(-40.0, withMoon(60.0, 90.0)) - dark_lx;
  EXPECT_NEAR(full_lx / quarter_lx, 11.0, 0.1 * 11.0);  // two digits are published
}

}  // namespace
}  // namespace sunlit::sky
