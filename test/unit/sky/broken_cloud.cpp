/// Shadows of broken cloud and what is seen of it beside the sun.
#include <gtest/gtest.h>

#include <tbb/global_control.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "sky/cloud_map.h"
#include "weathers.h"

namespace sunlit::sky {
namespace {

constexpr double kEarth_m = 6371e3;

/// Of clouds, and how far from what the disc makes of them they may be.
struct Shadows {
  double depth, sun_deg, base_m;
  double error;  ///< of the light in places that are partly lit, in parts of the clear hour's, the mean
};

/// Light of the sun that comes to places on the ground, in parts of the clear hour's: as the sky has it, and
/// as the mean over the disc, each of whose points shines through the map as it is.
class CloudShadow : public ::testing::TestWithParam<Shadows> {
 protected:
  CloudShadow()
      : shadows_(GetParam()),
        map_(kOktas, shadows_.depth, 0),
        day_(under(shadows_.sun_deg, weather())),
        mean_(map_.meanPassed(met(sunAt(shadows_.sun_deg).vector()).cosine)),
        passed_(map_.passed(met(sunAt(shadows_.sun_deg).vector()).cosine)) {
    const Eigen::Vector3d centre = sunAt(shadows_.sun_deg).vector();
    const Eigen::Vector3d right = centre.unitOrthogonal(), up = centre.cross(right);
    constexpr int kPoints = 32;
    constexpr double kGolden = 2.39996;  // turn that spreads points evenly over a disc
    for (int i = 0; i < kPoints; ++i) {
      const double r = sin(kSunRadiusAtOneAu) * std::sqrt((i + 0.5) / kPoints);
      const Eigen::Vector3d beside = std::cos(kGolden * i) * right + std::sin(kGolden * i) * up;
      disc_.push_back(met((centre + r * beside).normalized()).beside_m);
    }
  }

  double found(const Eigen::Vector2d& place) const {
    const Eigen::Vector3f at(static_cast<float>(place.x()), static_cast<float>(place.y()), 0.0F);
    return static_cast<double>(day_.throughCloud(day_.sun(), at)) * mean_;
  }
  double expected(const Eigen::Vector2d& place) const {
    double sum = 0.0;
    for (const Eigen::Vector2d& beside_m : disc_)
      sum += static_cast<double>(passed_.around(place + beside_m, 0.0F));
    return sum / static_cast<double>(disc_.size());
  }

  /// Across a beam, and so across its azimuth on the ground.
  double disc_m() const {
    return 2.0 * sin(kSunRadiusAtOneAu) * shadows_.base_m / std::sin(shadows_.sun_deg * kRadPerDeg);
  }

  static constexpr double kOktas = 4.0;
  struct Met {
    Eigen::Vector2d beside_m;  ///< from below
    double cosine;
  };
  Met met(const Eigen::Vector3d& towards) const {
    const double along = kEarth_m * towards.z();
    const double way_m =
        std::sqrt(along * along + shadows_.base_m * (2.0 * kEarth_m + shadows_.base_m)) - along;
    const double level = kEarth_m / (kEarth_m + shadows_.base_m);
    return {towards.head<2>() * way_m, std::sqrt(1.0 - level * level * (1.0 - towards.z() * towards.z()))};
  }
  Weather weather() const {
    Weather weather = covered(kOktas, shadows_.depth);
    weather.cloud_base_m = shadows_.base_m;
    return weather;
  }

  Shadows shadows_;
  CloudMap map_;
  Daylight day_;
  double mean_;
  CellMeans passed_;
  std::vector<Eigen::Vector2d> disc_;
};

/// Ways, m, over which light goes from 90 % to 10 % or back, median.
template <typename Light>
double edgeOf(const Eigen::Vector2d& along, const Light& light) {
  constexpr double kStep_m = 0.5;
  std::vector<double> widths;
  for (int line = 0; line < 4; ++line) {
    const Eigen::Vector2d from = Eigen::Vector2d(-along.y(), along.x()) * (line * 2373.0);
    double bright = -1.0, dark = -1.0;  // where it was so last
    for (int i = 0; i < 20000; ++i) {
      const double at = i * kStep_m, value = light(from + along * at);
      if (value > 0.9) {
        if (dark > bright) widths.push_back(at - dark);
        bright = at;
      } else if (value < 0.1) {
        if (bright > dark) widths.push_back(at - bright);
        dark = at;
      }
    }
  }
  std::sort(widths.begin(), widths.end());
  return widths.at(widths.size() / 2);
}

TEST_P(CloudShadow, LetsThroughWhatTheDiscMakesOfIt) {
  double error = 0.0, bias = 0.0, all = 0.0, all_expected = 0.0;
  int part_lit = 0;
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector2d place(i * 3.1, i * 7.7);
    const double light = found(place), disc = expected(place);
    all += light;
    all_expected += disc;
    if (disc < 0.02 || disc > 0.98) continue;
    error += std::abs(light - disc);
    bias += light - disc;
    ++part_lit;
  }
  ASSERT_GT(part_lit, 500);
  EXPECT_LT(error / part_lit, shadows_.error);
  // What cells let through is kept, wherever edges blur it to: 32 points of the disc and a few hundred edges
  // leave so much.
  EXPECT_NEAR(bias / part_lit, 0.0, 0.006);
  EXPECT_NEAR(all / all_expected, 1.0, 0.001);
}

TEST_P(CloudShadow, HasEdgesAsWideAsTheCloudsOwnAndTheDiscTogether) {
  const Eigen::Vector2d away = sunAt(shadows_.sun_deg).vector().head<2>().normalized();
  for (const bool along : {true, false}) {
    const Eigen::Vector2d way = along ? away : Eigen::Vector2d(-away.y(), away.x());
    const double edge = edgeOf(way, [&](const Eigen::Vector2d& place) { return found(place); });
    const double disc = edgeOf(way, [&](const Eigen::Vector2d& place) { return expected(place); });
    // The median of some twenty edges. Cells widen or narrow by factors of √2, and to all sides alike, where
    // the disc is longer along the sun's azimuth by 1 / sin h.
    EXPECT_GT(edge, 0.7 * disc) << along;
    EXPECT_LT(edge, 1.2 * disc) << along;
    // From 90 to 10 % is 0.687 of the disc's width behind a straight edge, 6.4 m a kilometre; the map's own
    // edges, drawn in cells of 10 m, are wider below a cloud that is near.
    EXPECT_GT(edge, 0.687 * disc_m()) << along;
    EXPECT_GT(edge, 15.0) << along;
  }
}

// Measured 0.0002, 0.012, 0.039, 0.054, 0.055 and 0.088: cells of 10 m are the narrowest blur there is, as
// wide as that of a disc of 20 m, and have the place of one wider.
INSTANTIATE_TEST_SUITE_P(
    SunsAndBases, CloudShadow,
    ::testing::Values(Shadows{30.0, 89.9, 100.0, 0.001}, Shadows{30.0, 89.9, 1000.0, 0.02},
                      Shadows{30.0, 89.9, 2000.0, 0.05}, Shadows{30.0, 30.0, 1000.0, 0.07},
                      Shadows{30.0, 30.0, 2000.0, 0.07}, Shadows{10.0, 15.0, 1500.0, 0.11}));

TEST(CloudShadows, StayWhileTheDiscSetsThroughTheHorizon) {
  // Half of it still shines when its middle has set: places in gaps and below clouds keep what they had.
  const Weather weather = covered(4.0);
  const Daylight before = under(0.0005, weather), after = under(-0.0005, weather);
  int differ = 0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3f place(static_cast<float>(i) * 331.0F, static_cast<float>(i) * 57.0F, 0.0F);
    const float through = before.throughCloud(before.sun(), place);
    // The way of 138 km to the cloud is 55 m longer, which moves edges by as much: 0.055 measured.
    EXPECT_NEAR(after.throughCloud(after.sun(), place), through, 0.1F) << i;
    differ += std::abs(through - 1.0F) > 0.3F ? 1 : 0;
  }
  EXPECT_GT(differ, 100);
}

/// What comes straight through from an elevation above the sun's azimuth, in parts.
double passed(const Daylight& day, const CloudMap& map, double elevation_deg, const Eigen::Vector3f& place) {
  DiscLight light = day.sun();
  light.towards = sunAt(elevation_deg);
  return static_cast<double>(day.throughCloud(light, place)) *
         map.meanPassed(std::sin(elevation_deg * kRadPerDeg));
}

TEST(CloudMap, HasTheSameBitsForAnyThreads) {
  const auto made = [](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    const CloudMap map(4.0, 20.0, 4);
    return std::pair{map.cells(), map.passed(0.5).cells()};
  };
  const auto alone = made(1);
  for (const int threads : {2, 3, 8}) EXPECT_TRUE(made(threads) == alone) << threads;
}

TEST(CloudMap, LetsThroughEachCellWhatItsDepthLeaves) {
  constexpr double kCosine = 0.4;
  const CloudMap map(4.0, 3.0, 4);
  const CellMeans passed = map.passed(kCosine);
  double sum = 0.0;
  for (std::size_t i = 0; i < map.cells().size(); ++i) {
    const double expected = std::exp(-static_cast<double>(map.cells()[i]) / kCosine);
    ASSERT_NEAR(static_cast<double>(passed.cells()[i]), expected, 1e-6) << i;  // floats
    sum += expected;
  }
  EXPECT_NEAR(map.meanPassed(kCosine), sum / static_cast<double>(map.cells().size()), 1e-4);
  // Over a square that repeats itself, whatever it is blurred by, the mean stays.
  for (const float width_m : {0.0F, 25.0F, 600.0F}) {
    double blurred = 0.0;
    constexpr int kSide = 256;
    for (int i = 0; i < kSide * kSide; ++i)
      blurred += static_cast<double>(passed.around({40.0 * (i % kSide), 40.0 * (i / kSide)}, width_m));
    EXPECT_NEAR(blurred / (kSide * kSide), map.meanPassed(kCosine), 0.002) << width_m;  // of 40 m steps
  }
}

TEST(BrokenCloud, IsAsHighOverGroundAtAnyHeightInTheMap) {
  constexpr double kSun_deg = 50.0;
  constexpr float kLevel_m = 1600.0F;  // above the base
  const Daylight low = under(kSun_deg, covered(4.0)), high = low.overGround(kLevel_m);
  const Eigen::Vector3f rise(0.0F, 0.0F, kLevel_m);
  for (const double elevation_deg : {0.0, 10.0, 50.0, 80.0}) {
    const Eigen::Vector3f way = towards(elevation_deg);
    EXPECT_TRUE((high.skyLuminance(way).value == low.skyLuminance(way).value).all());  // of no place
    for (int i = 0; i < 100; ++i) {
      // Below the ground's level, on it and above.
      const Eigen::Vector3f place(static_cast<float>(i) * 170.0F, static_cast<float>(i) * 53.0F,
                                  static_cast<float>(i - 20));
      EXPECT_TRUE((high.skyLuminance(way, place + rise).value == low.skyLuminance(way, place).value).all());
      const Daylight there = high.seenFrom(place + rise), here = low.seenFrom(place);
      EXPECT_TRUE((there.skyLuminance(way).value == here.skyLuminance(way).value).all());
      EXPECT_TRUE((there.sunSeen().illuminance.value == here.sunSeen().illuminance.value).all());
      EXPECT_EQ(high.throughCloud(high.sun(), place + rise), low.throughCloud(low.sun(), place));
    }
  }
}

TEST(BrokenCloud, HasItsShadowsFurtherAsideInAValley) {
  // The cloud is 2000 m above the valley's floor, not 1500: a place 500 m below the level, by that much
  // further along the beam, lies in the same light.
  constexpr double kSun_deg = 45.0;
  const Daylight day = under(kSun_deg, covered(4.0));
  const Eigen::Vector3f down = -500.0F / towards(kSun_deg).z() * towards(kSun_deg);
  int lit = 0, shaded = 0;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3f place(static_cast<float>(i) * 170.0F, static_cast<float>(i) * 53.0F, 0.0F);
    const float above = day.throughCloud(day.sun(), place);
    EXPECT_NEAR(day.throughCloud(day.sun(), place + down), above, 0.35F) << i;  // the disc's blur is wider
    (above > 1.0F ? lit : shaded) += 1;
  }
  EXPECT_GT(std::min(lit, shaded), 40);
}

TEST(SilverLining, AThinEdgeBesideAHiddenSunIsBrighterThanAThickMiddle) {
  constexpr double kSun_deg = 50.0, kBeside_deg = 2.0;
  const Weather weather = covered(4.0);
  const Daylight day = under(kSun_deg, weather);
  const CloudMap map(weather.cover_oktas, opticalDepthOf(weather), 0);
  const auto sun =
      static_cast<double>(usualAir().daylight({sunAt(kSun_deg), 1.0}).sun().illuminance.luminance());
  double thin = 0.0, once = 0.0, thick = 0.0;
  int edges = 0, middles = 0;
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3f place(static_cast<float>(i) * 17.0F, static_cast<float>(i) * 5.3F, 0.0F);
    if (passed(day, map, kSun_deg, place) > 0.01) continue;
    const double slant = -std::log(passed(day, map, kSun_deg + kBeside_deg, place));
    const auto seen = [&] {
      const Eigen::Vector3f beside = towards(kSun_deg + kBeside_deg);
      return static_cast<double>(day.seenFrom(place).skyLuminance(beside).luminance());
    };
    if (slant > 0.7 && slant < 1.5) {
      const float turned = std::cos(static_cast<float>(kBeside_deg * kRadPerDeg));
      thin += seen();
      once += sun * slant * std::exp(-slant) * static_cast<double>(dropletPhase(turned));
      ++edges;
    } else if (slant > 12.0) {
      thick += seen();
      ++middles;
    }
  }
  ASSERT_GT(edges, 20);
  ASSERT_GT(middles, 200);
  // Light that one droplet turns by 2 degrees, E s e^−s p, is most of what an edge sends: the rest is turned
  // by several, and some is sky behind.
  EXPECT_GT(thin, 0.9 * once);
  EXPECT_LT(thin, 1.6 * once);
  EXPECT_GT(thin / edges, 4.0 * thick / middles);
}

}  // namespace
}  // namespace sunlit::sky
