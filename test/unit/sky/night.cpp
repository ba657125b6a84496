#include "sunlit/sky/night.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "directions.h"
#include "sky/night_glow.h"
#include "sky/spectrum.h"
#include "sunlit/sky/atmosphere.h"
#include "support/message_of.h"

namespace sunlit::sky {
namespace {

const SunInSky kSetSun{at(300.0, -40.0), 1.0};

NightSky withMoon(const Direction& towards, double phase_angle_deg, double distance_m = 384400e3) {
  return {MoonInSky{towards, std::nullopt, distance_m, Angle::degrees(phase_angle_deg)}, std::nullopt,
          nullptr};
}

DiscLight moonAt(const Direction& towards, double phase_angle_deg, double distance_m = 384400e3) {
  return usualAir().daylight(kSetSun, withMoon(towards, phase_angle_deg, distance_m)).moon();
}

TEST(Moon, ItsDiscIsAsLargeAsItIsNear) {
  // 1737.4 km at 384,400 km: 0.2590°.
  EXPECT_NEAR(moonAt(at(90.0, 40.0), 0.0).angular_radius.deg(), 0.2590, 1e-4);
  const DiscLight near = moonAt(at(90.0, 40.0), 0.0, 3.57e8);
  const DiscLight far = moonAt(at(90.0, 40.0), 0.0, 4.07e8);
  const auto square = static_cast<float>(std::pow(4.07 / 3.57, 2));
  EXPECT_NEAR(near.illuminance.luminance() / far.illuminance.luminance(), square, 1e-4F);  // rounding
}

TEST(Moon, TheSunLightsItAtThePhaseAngle) {
  const Direction towards = at(120.0, 35.0);
  for (const double phase_deg : {0.0, 60.0, 90.0, 150.0}) {
    const DiscLight moon = moonAt(towards, phase_deg);
    ASSERT_TRUE(moon.lit_from.has_value());
    const Eigen::Vector3d lit_from = moon.lit_from->vector();
    EXPECT_NEAR(lit_from.dot(-towards.vector()), std::cos(phase_deg * kRadPerDeg), 1e-9);  // rounding
    if (phase_deg > 0.0) {
      // Its bright limb points to where the sun is.
      const Eigen::Vector3d across = lit_from - lit_from.dot(towards.vector()) * towards.vector();
      EXPECT_GT(across.dot(kSetSun.apparent.vector()), 0.0);
    }
  }
}

TEST(Moon, ItWanesToNothing) {
  float before = std::numeric_limits<float>::infinity();
  for (int phase_deg = 0; phase_deg <= 180; phase_deg += 5) {
    const float now = moonAt(at(90.0, 50.0), phase_deg).illuminance.luminance();
    EXPECT_LT(now, before) << phase_deg;
    before = now;
  }
  EXPECT_EQ(before, 0.0F);
}

TEST(Moon, ItSetsAndReddensAsTheSunDoes) {
  EXPECT_GT(moonAt(at(90.0, -0.25), 0.0).illuminance.value.maxCoeff(), 0.0F);
  EXPECT_EQ(moonAt(at(90.0, -0.26), 0.0).illuminance.value.maxCoeff(), 0.0F);
  const auto redness = [](double elevation_deg) {
    const Eigen::Array3f rgb = moonAt(at(90.0, elevation_deg), 0.0).illuminance.value;
    return rgb[0] / rgb[1];
  };
  EXPECT_GT(redness(5.0), redness(20.0));
  EXPECT_GT(redness(20.0), redness(60.0));
}

TEST(Moon, ItIsALittleRedderThanTheSun) {
  // B − V of 0.92 and 0.65: a factor of 1.28 between 440 and 550 nm. Blue and green of sRGB lie 80 nm apart.
  const Eigen::Array3f moon = moonAt(at(90.0, 60.0), 0.0).illuminance.value;
  const Eigen::Array3f sun = usualAir().daylight({at(90.0, 60.0), 1.0}).sun().illuminance.value;
  EXPECT_NEAR((moon[1] / moon[2]) / (sun[1] / sun[2]), 1.2, 0.1);
}

TEST(Moon, TheAirScattersItsLightAsTheSuns) {
  // The same tables: a sky like the day's, 4e5 times darker and a little redder. So luminance is in
  // proportion up to what colour does to the parts of the sky: 5 %.
  const Direction towards = at(90.0, 30.0);
  const Daylight night = usualAir().daylight(kSetSun, withMoon(towards, 0.0));
  const Daylight dark = usualAir().daylight(kSetSun);
  const Daylight day = usualAir().daylight({towards, 1.0});
  const Eigen::Vector3f up(0.0F, 0.0F, 1.0F);
  const auto moonlit = [&](const Eigen::Vector3f& v) {
    return (night.skyLuminance(v).luminance() - dark.skyLuminance(v).luminance()) /
           day.skyLuminance(v).luminance();
  };
  for (const Direction& v : {at(90.0, 32.0), at(200.0, 5.0), at(300.0, 45.0)}) {
    EXPECT_NEAR(moonlit(v.vector().cast<float>()) / moonlit(up), 1.0F, 0.1F);
  }
  EXPECT_NEAR(moonlit(up), 0.314 / 126000.0, 0.1 * 0.314 / 126000.0);  // V = −12.73 is 0.314 lx
}

TEST(Moon, ImpossibleOnesAreRefused) {
  EXPECT_EQ(messageOf([] { moonAt(at(0.0, 10.0), 190.0); }),
            "moon phase_angle is 190, but must be from 0 to 180 deg");
  EXPECT_EQ(messageOf([] { moonAt(at(0.0, 10.0), 0.0, 1e8); }),
            "moon distance is 100000000, but must be from 340000000 to 420000000 m");
}

TEST(Glow, ZodiacalLightFollowsThePublishedTable) {
  // Leinert et al. 1998, table 16, in stars of V = 10 a square degree. The fit is within 25 % of all of it.
  const double s10 = kZeroMagnitude_lx * 1e-4 / (kRadPerDeg * kRadPerDeg);
  const auto expect = [&](double from_sun_deg, double latitude_deg, double stars) {
    const double cosine = std::cos(from_sun_deg * kRadPerDeg) * std::cos(latitude_deg * kRadPerDeg);
    const double ours =
        zodiacalLight_cd_per_m2(Angle::radians(std::acos(cosine)), std::sin(latitude_deg * kRadPerDeg));
    EXPECT_NEAR(ours / s10, stars, 0.25 * stars) << from_sun_deg << ", " << latitude_deg;
  };
  expect(30.0, 0.0, 1940.0);
  expect(60.0, 0.0, 395.0);
  expect(90.0, 0.0, 202.0);
  expect(180.0, 0.0, 180.0);  // the counterglow
  expect(0.0, 90.0, 60.0);
}

TEST(Glow, ItsMeansAreThoseOverTheSphere) {
  double zodiacal = 0.0;
  double galactic = 0.0;
  int far_from_sun = 0;
  constexpr int kBelts = 200;
  constexpr int kSectors = 200;
  for (int belt = 0; belt < kBelts; ++belt) {
    const double sin_latitude = -1.0 + 2.0 * (belt + 0.5) / kBelts;
    for (int sector = 0; sector < kSectors; ++sector) {
      const double cos_longitude = std::cos(2.0 * kPi * (sector + 0.5) / kSectors);
      const double cos_elongation = std::sqrt(1.0 - sin_latitude * sin_latitude) * cos_longitude;
      if (cos_elongation < std::cos(45.0 * kRadPerDeg)) {
        zodiacal += zodiacalLight_cd_per_m2(Angle::radians(std::acos(cos_elongation)), sin_latitude);
        ++far_from_sun;
      }
      galactic += milkyWay_cd_per_m2(sin_latitude, cos_longitude);
    }
  }
  // The constants have two digits.
  EXPECT_NEAR(galactic / (kBelts * kSectors), kMeanMilkyWay_cd_per_m2, 0.05 * kMeanMilkyWay_cd_per_m2);
  EXPECT_NEAR(zodiacal / far_from_sun, kMeanZodiacal_cd_per_m2, 0.05 * kMeanZodiacal_cd_per_m2);
}

TEST(Glow, AirglowIsMostOfADarkSky) {
  // 65 % airglow, 27 % zodiacal light, 7 % stars (Roach & Gordon 1973), far from the sun, the ecliptic and
  // the Milky Way; each within a factor of 2.
  const double zodiacal = zodiacalLight_cd_per_m2(Angle::degrees(120.0), std::sin(50.0 * kRadPerDeg));
  const double stars = milkyWay_cd_per_m2(std::sin(60.0 * kRadPerDeg), 0.0);
  const double all = kAirglowZenith_cd_per_m2 + zodiacal + stars;
  EXPECT_NEAR(std::log2(kAirglowZenith_cd_per_m2 / all / 0.65), 0.0, 1.0);
  EXPECT_NEAR(std::log2(zodiacal / all / 0.27), 0.0, 1.0);
  EXPECT_NEAR(std::log2(stars / all / 0.07), 0.0, 1.0);
}

TEST(Glow, ADarkSkyHasItsMeasuredColour) {
  // The zenith over Kitt Peak (Neugent & Massey 2010, spectra of 2009 and 2010 weighed with CIE 1931): xy of
  // (0.37, 0.37) and (0.35, 0.37). The sky of observatories' exposure calculators, which has the red oxygen
  // lines of the tropics, has (0.39, 0.35).
  const Eigen::Array3d rgb =
      usualAir().daylight(kSetSun).skyLuminance({0.0F, 0.0F, 1.0F}).value.cast<double>();
  Eigen::Matrix3d xyz_from_rgb;  // IEC 61966-2-1
  xyz_from_rgb << 0.4124, 0.3576, 0.1805, 0.2126, 0.7152, 0.0722, 0.0193, 0.1192, 0.9505;
  const Eigen::Vector3d xyz = xyz_from_rgb * rgb.matrix();
  EXPECT_NEAR(xyz.x() / xyz.sum(), 0.36, 0.015);
  EXPECT_NEAR(xyz.y() / xyz.sum(), 0.365, 0.015);
}

TEST(Glow, ItTurnsWithTheSky) {
  const Eigen::Matrix3d tilted =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.3, -0.8, 0.5).normalized()).toRotationMatrix();
  const double turn = 2.0 * kPi / GlowSky::kColumns * 20;
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const SunInSky sun{at(0.0, -90.0), 1.0};  // turning about the vertical leaves it in its place
  const Daylight before = usualAir().daylight(sun, NightSky{std::nullopt, tilted, nullptr});
  const Daylight after =
      usualAir().daylight(sun, NightSky{std::nullopt, Eigen::Matrix3d(turned * tilted), nullptr});
  double least = 1.0;
  double most = 0.0;
  for (int azimuth_deg = 0; azimuth_deg < 360; azimuth_deg += 10) {
    const Eigen::Vector3f v = at(azimuth_deg, 40.0).vector().cast<float>();
    const float then = before.skyLuminance(v).luminance();
    EXPECT_NEAR(after.skyLuminance(turned.cast<float>() * v).luminance(), then, 1e-3F * then);  // rounding
    least = std::min<double>(least, then);
    most = std::max<double>(most, then);
  }
  EXPECT_GT(most, 1.3 * least);  // the Milky Way is in it
}

std::shared_ptr<const std::vector<Star>> starsTowards(const std::vector<Eigen::Vector3d>& directions) {
  auto stars = std::make_shared<std::vector<Star>>();
  for (const Eigen::Vector3d& direction : directions) {
    stars->push_back({direction.normalized().cast<float>(), starIlluminance(1.0, 0.65)});
  }
  return stars;
}

TEST(Stars, OnlyThoseAboveTheHorizonAreSeenBrightestFirst) {
  NightSky night;
  night.map_from_celestial = Eigen::Matrix3d::Identity();
  night.stars = starsTowards({{1, 0, 0.2}, {0, 0, 1}, {0, 1, -0.1}, {0, 1, 1}});
  const std::vector<PointLight> seen = usualAir().daylight(kSetSun, night).stars();
  ASSERT_EQ(seen.size(), 3U);
  for (std::size_t i = 1; i < seen.size(); ++i) {
    EXPECT_GE(seen[i - 1].illuminance.luminance(), seen[i].illuminance.luminance());
  }
  EXPECT_NEAR(seen[0].towards.z(), 1.0F, 1e-6F);  // the least air is overhead
  night.map_from_celestial = std::nullopt;
  EXPECT_TRUE(usualAir().daylight(kSetSun, night).stars().empty());
}

TEST(Stars, RefractionRaisesThemAndAirDimsThem) {
  NightSky night;
  night.map_from_celestial = Eigen::Matrix3d::Identity();
  const double true_deg = -0.4;
  night.stars = starsTowards({at(70.0, true_deg).vector(), at(70.0, 90.0).vector()});
  const std::vector<PointLight> seen = usualAir().daylight(kSetSun, night).stars();
  ASSERT_EQ(seen.size(), 2U);
  // A star 24′ below the horizon is seen 7′ above it (Meeus, Astronomical Algorithms, ch. 16).
  EXPECT_NEAR(std::asin(seen[1].towards.z()) / kRadPerDeg * 60.0, 7.0, 3.0);
  EXPECT_NEAR(std::atan2(seen[1].towards.x(), seen[1].towards.y()) / kRadPerDeg, 70.0, 1e-3);
  // At the zenith clear air takes 0.2-0.3 mag; the visual optical depth of ours is 0.22.
  const float passed = seen[0].illuminance.luminance() / starIlluminance(1.0, 0.65).luminance();
  EXPECT_NEAR(-std::log(passed), 0.22F, 0.02F);
  EXPECT_LT(seen[1].illuminance.luminance(), 1e-3F * seen[0].illuminance.luminance());
}

TEST(Stars, BrightnessAndColourFollowMagnitudeAndIndex) {
  EXPECT_NEAR(starIlluminance(0.0, 0.65).luminance(), 2.54e-6F, 1e-8F);
  EXPECT_NEAR(starIlluminance(5.0, 1.5).luminance(), 2.54e-8F, 1e-10F);  // five magnitudes are 100 times
  const auto redness = [](double b_minus_v) {
    const LinearRgb light = starIlluminance(0.0, b_minus_v);
    return light.value[0] / light.value[2];
  };
  EXPECT_LT(redness(-0.3), redness(0.65));
  EXPECT_LT(redness(0.65), redness(1.8));
  // The sun's index gives about the sun's colour: Ballesteros has 5,840 K for it.
  const LinearRgb sunlight = colourOf(Spectrum::Ones());
  EXPECT_NEAR(redness(0.65), sunlight.value[0] / sunlight.value[2], 0.06F);
  const LinearRgb white = starIlluminance(2.0, std::nan(""));
  EXPECT_EQ(white.value[0], white.value[2]);
}

}  // namespace
}  // namespace sunlit::sky
