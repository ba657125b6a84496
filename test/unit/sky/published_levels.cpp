/// Light of the day and of the night against published levels.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "sunlit/sky/atmosphere.h"

namespace sunlit::sky {
namespace {

const Atmosphere& clearAir() {
  static const Atmosphere atmosphere{AtmosphereOptions{}};
  return atmosphere;
}

Direction at(double azimuth_deg, double elevation_deg) {
  return Direction(Azimuth::degrees(azimuth_deg), Angle::degrees(elevation_deg));
}

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

/// Janiczek & DeYoung 1987, USNO Circular 171, table of the sun; below −12° with the night's own light.
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

double ground_lx(double elevation_deg, const NightSky& night = {}) {
  return clearAir().daylight({at(137.0, elevation_deg), 1.0}, night).groundIlluminance().luminance();
}

NightSky withMoon(double elevation_deg, double phase_angle_deg) {
  NightSky night;
  night.moon = MoonInSky{at(40.0, elevation_deg), std::nullopt, 384400e3, Angle::degrees(phase_angle_deg)};
  return night;
}

TEST(PublishedLevels, DayAndTwilight) {
  // Clear air differs by 15 % under a high sun; haze counts for more under a low one, and in twilight a
  // degree of sun is a factor of 3.
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

TEST(PublishedLevels, TheZenithFadesThroughTwilightAsMeasured) {
  // Patat et al. 2006 (A&A 455, 385), table 1: V = 11.84 + 1.518 d − 0.057 d² mag a square arc second, d the
  // degrees of the sun below −5°, over Paranal; 0 mag is 1.08e5 cd/m². Their air is 2.6 km higher and
  // clearer, V is not quite luminance, and the night under it varies: 30 %. The sky falls by a factor of
  // 1,600 meanwhile.
  for (const double elevation_deg : {-6.0, -8.0, -10.0, -12.0, -14.0, -15.0}) {
    const double d = -5.0 - elevation_deg;
    const double published = 1.08e5 * std::pow(10.0, -0.4 * (11.84 + 1.518 * d - 0.057 * d * d));
    const Daylight light = clearAir().daylight({at(137.0, elevation_deg), 1.0});
    const double ours = light.skyLuminance({0.0F, 0.0F, 1.0F}).luminance();
    EXPECT_NEAR(ours, published, 0.3 * published) << elevation_deg;
  }
}

TEST(PublishedLevels, DeepTwilightPassesIntoTheNight) {
  // Within a factor of 2: the airglow alone varies by that with the sun's activity.
  for (const double elevation_deg : {-15.0, -18.0}) {
    const double ratio = ground_lx(elevation_deg) / sunAndSky_lx(elevation_deg);
    EXPECT_GT(ratio, 0.5) << elevation_deg;
    EXPECT_LT(ratio, 2.0) << elevation_deg;
  }
  // A moonless night gives 1e-3 lx (Schlyter; Seidelmann 1992), the zenith 2e-4 cd/m², 21.8 mag a square
  // arc second.
  const Daylight night = clearAir().daylight({at(0.0, -40.0), 1.0});
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
    // Two phase laws differ by 10 %, air by 15 %; the published curve of the sun, too, falls faster to 30°.
    EXPECT_NEAR(moon_lx, published, (elevation_deg > 45.0 ? 0.25 : 0.4) * published) << elevation_deg;
  }
  // Sky under a full moon: 5e-3 cd/m² away from it, within a factor of 2.
  const Daylight night = clearAir().daylight({at(220.0, -40.0), 1.0}, withMoon(45.0, 0.0));
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
