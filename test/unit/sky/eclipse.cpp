#include "sunlit/sky/eclipse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

#include "directions.h"
#include "support/usual_air.h"

namespace sunlit::sky {
namespace {

Overlap discs(double apart_deg, double cover_deg, double radius_deg = 0.25) {
  return {Angle::degrees(apart_deg), Angle::degrees(radius_deg), Angle::degrees(cover_deg)};
}

/// Share that points of a fine grid find, within 1e-4.
double countedArea(const Overlap& two) {
  constexpr int kSide = 2000;
  const double apart = two.apart.rad() / two.radius.rad();
  const double cover = two.cover_radius.rad() / two.radius.rad();
  int all = 0, free = 0;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const double x = 2.0 * (i + 0.5) / kSide - 1.0, y = 2.0 * (j + 0.5) / kSide - 1.0;
      if (x * x + y * y > 1.0) continue;
      ++all;
      if (std::hypot(x - apart, y) > cover) ++free;
    }
  }
  return static_cast<double>(free) / all;
}

TEST(Overlap, LeavesTheAreaThatAGridFinds) {
  for (const double cover_deg : {0.1, 0.24, 0.25, 0.26, 0.9}) {
    for (const double apart_deg : {0.0, 0.005, 0.15, 0.26, 0.4, 0.7}) {
      const Overlap two = discs(apart_deg, cover_deg);
      EXPECT_NEAR(uncoveredArea(two), countedArea(two), 2e-4) << cover_deg << " " << apart_deg;
    }
  }
}

TEST(Overlap, IsOneOutsideAndNothingWithinAndGoesSteadilyBetween) {
  EXPECT_EQ(uncoveredSunlight(discs(0.52, 0.26)), 1.0);
  EXPECT_EQ(uncoveredArea(discs(0.52, 0.26)), 1.0);
  EXPECT_EQ(uncoveredSunlight(discs(0.009, 0.26)), 0.0);
  double before = 0.0;
  // 0.0001° are 0.4 s of an eclipse; the middle of the disc is 1.24 times as bright as its mean.
  for (double apart_deg = 0.0; apart_deg < 0.52; apart_deg += 1e-4) {
    const double share = uncoveredSunlight(discs(apart_deg, 0.26));
    EXPECT_GE(share, before - 1e-9) << apart_deg;
    EXPECT_LE(share, before + 4e-4) << apart_deg;
    before = share;
  }
  EXPECT_NEAR(before, 1.0, 1e-4);
}

TEST(Overlap, LeavesLessLightOfADarkRimThanOfAnEvenDisc) {
  // 0.30 to 0.60 of the middle's brightness over the last tenth of the radius, of a mean of 0.805.
  const Overlap crescent = discs(0.04, 0.27);
  const double area = uncoveredArea(crescent), light = uncoveredSunlight(crescent);
  EXPECT_GT(light, area * 0.30 / 0.805);
  EXPECT_LT(light, area * 0.70 / 0.805);
  // A ring of the outer 0.05 radii: in closed form.
  const Overlap ring = discs(0.0, 0.95 * 0.25);
  const double rest = 1.0 - 0.95 * 0.95;
  EXPECT_NEAR(uncoveredSunlight(ring),
              (0.30 * rest + 0.93 * 2.0 / 3.0 * std::pow(rest, 1.5) - 0.23 * 0.5 * rest * rest) / 0.805,
              1e-9);
}

const Direction kHigh = at(200.0, 60.0);

/// A moon whose middle is that far above the sun's.
NightSky moonAbove(double apart_deg, double distance_m = 360000e3) {
  const Direction moon = at(200.0, 60.0 + apart_deg);
  return {MoonInSky{moon, std::nullopt, distance_m, Angle::degrees(179.5)}, std::nullopt, nullptr};
}

TEST(SolarEclipse, DimsDiscSkyAndGround) {
  const Daylight whole = usualAir().daylight({kHigh, 1.0});
  const Daylight half = usualAir().daylight({kHigh, 1.0}, moonAbove(0.3));
  const Overlap two = sunBehindMoon({kHigh, 1.0}, *moonAbove(0.3).moon);
  const double left = uncoveredSunlight(two);
  ASSERT_GT(left, 0.3);
  ASSERT_LT(left, 0.7);
  const Eigen::Vector3f north = Eigen::Vector3f(0.0F, 0.8F, 0.6F);
  // Float.
  const auto expectDimmed = [&](const LinearRgb& now, const LinearRgb& before) {
    EXPECT_NEAR(now.luminance() / before.luminance(), left, 2e-3 * left);
  };
  expectDimmed(half.sun().illuminance, whole.sun().illuminance);
  expectDimmed(half.skyLuminance(north), whole.skyLuminance(north));
  expectDimmed(half.groundIlluminance(), whole.groundIlluminance());
  ASSERT_TRUE(half.sun().cover.has_value());
  EXPECT_NEAR(half.sun().cover->towards.elevation().deg(), 60.3, 1e-6);
}

TEST(SolarEclipse, LeavesTwilightInTotality) {
  const Daylight dark = usualAir().daylight({kHigh, 1.0}, moonAbove(0.001));
  EXPECT_EQ(dark.sun().illuminance.luminance(), 0.0F);
  // Published: a few lux; the zenith of 21 August 2017 had 12.4 to 13.3 mag a square arc second, 0.5 to 1.2
  // cd/m².
  EXPECT_GT(dark.groundIlluminance().luminance(), 1.0F);
  EXPECT_LT(dark.groundIlluminance().luminance(), 10.0F);
  EXPECT_GT(dark.skyLuminance(Eigen::Vector3f::UnitZ()).luminance(), 0.3F);
  EXPECT_LT(dark.skyLuminance(Eigen::Vector3f::UnitZ()).luminance(), 2.0F);
}

TEST(SolarEclipse, DimsTheOvercastSky) {
  for (const Overcast kind : {Overcast::kLayer, Overcast::kCie}) {
    Weather overcast;
    overcast.cover_oktas = 8.0;
    overcast.overcast = kind;
    const auto groundUnder = [&](const NightSky& night) {
      return usualAir().daylight({kHigh, 1.0}, night, overcast).groundIlluminance().luminance();
    };
    const double left = uncoveredSunlight(sunBehindMoon({kHigh, 1.0}, *moonAbove(0.3).moon));
    EXPECT_NEAR(groundUnder(moonAbove(0.3)) / groundUnder({}), left, 3e-3 * left);
  }
}

TEST(SolarEclipse, ChangesNoBitWhereTheDiscsDoNotTouch) {
  const Daylight alone = usualAir().daylight({kHigh, 1.0});
  const Daylight beside = usualAir().daylight({kHigh, 1.0}, moonAbove(0.56));
  EXPECT_TRUE((alone.sun().illuminance.value == beside.sun().illuminance.value).all());
  EXPECT_FALSE(beside.sun().cover.has_value());
  const Eigen::Vector3f north = Eigen::Vector3f(0.0F, 0.8F, 0.6F);
  EXPECT_TRUE((alone.skyLuminance(north).value == beside.skyLuminance(north).value).all());
}

TEST(SolarEclipse, StandsWhereItIsWithoutRefraction) {
  const Direction seen = at(270.0, 1.0), is = at(270.0, 0.6);
  NightSky night;
  night.moon = MoonInSky{at(270.0, 1.25), at(270.0, 0.9), 360000e3, Angle::degrees(179.5)};
  const Daylight day = usualAir().daylight({seen, 1.0, is}, night);
  ASSERT_TRUE(day.sun().cover.has_value());
  EXPECT_NEAR(day.sun().cover->towards.elevation().deg(), 1.3, 1e-4);
}

const SunInSky kMidnight{at(0.0, -40.0), 1.0};

/// A full moon that far above the middle of the shadow as it is seen from the middle of the Earth.
MoonInSky moonFromShadow(double apart_deg) {
  const double distance_m = 384400e3;
  const Direction from_centre = at(180.0, 40.0 + apart_deg);
  const Eigen::Vector3d to_moon = distance_m * from_centre.vector() - Eigen::Vector3d(0.0, 0.0, 6371000.0);
  return {Direction(to_moon), std::nullopt, to_moon.norm(), Angle::degrees(0.5)};
}

TEST(LunarEclipse, HasPenumbraAndUmbraOfThePublishedSize) {
  // Of 1.01 · 0.9507° ± 0.2666°, the parallax of the sun 0.0024°, and the moon's radius of 0.259°; of it the
  // outermost points lie at 0.98.
  EXPECT_EQ(sunlightOnMoon(kMidnight, moonFromShadow(1.2292 + 0.26)), 1.0);
  EXPECT_LT(sunlightOnMoon(kMidnight, moonFromShadow(1.2292 + 0.24)), 1.0);
  EXPECT_EQ(sunlightOnMoon(kMidnight, moonFromShadow(0.6960 - 0.265)), 0.0);
  EXPECT_GT(sunlightOnMoon(kMidnight, moonFromShadow(0.6960 - 0.245)), 0.0);
  double before = 0.0;
  for (double apart_deg = 0.0; apart_deg < 1.5; apart_deg += 0.002) {
    const double share = sunlightOnMoon(kMidnight, moonFromShadow(apart_deg));
    EXPECT_GE(share, before - 1e-9);
    EXPECT_LE(share, before + 0.006);  // the penumbra is 0.53° wide
    before = share;
  }
  EXPECT_EQ(before, 1.0);
}

TEST(LunarEclipse, IsDarkAndRed) {
  const auto moonAt = [](double apart_deg) {
    return usualAir()
        .daylight(kMidnight, {moonFromShadow(apart_deg), std::nullopt, nullptr})
        .moon()
        .illuminance;
  };
  const LinearRgb full = moonAt(2.0), eclipsed = moonAt(0.0);
  // The red part is luminance too, but reddened once more by the air here.
  EXPECT_NEAR(eclipsed.luminance() / full.luminance(), kMoonInUmbra, 0.3 * kMoonInUmbra);
  EXPECT_GT(eclipsed.value[0] / eclipsed.value[1], 3.0F * full.value[0] / full.value[1]);
}

}  // namespace
}  // namespace sunlit::sky
