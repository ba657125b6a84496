/// Cloud and fog against published numbers and what can be worked out on paper.
#include "sunlit/sky/weather.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "sky/cie_sky.h"
#include "sky/cloud_map.h"
#include "support/message_of.h"
#include "weathers.h"

namespace sunlit::sky {
namespace {

TEST(Weather, WithoutAnyTheSkyIsTheClearOneToTheBit) {
  const Daylight clear = usualAir().daylight({sunAt(35.0), 1.0});
  Weather none;
  none.optical_depth = 20.0;  // of a cloud that is not there
  none.wind_m_per_s = 10.0;
  none.clock_s = 1e6;
  const Daylight same = under(35.0, none);
  for (const double elevation : {-20.0, 0.0, 3.0, 40.0, 90.0}) {
    EXPECT_TRUE(
        (clear.skyLuminance(towards(elevation)).value == same.skyLuminance(towards(elevation)).value).all());
    EXPECT_TRUE((clear.airOver(towards(elevation), 700.0F).airlight ==
                 same.airOver(towards(elevation), 700.0F).airlight)
                    .all());
  }
  EXPECT_EQ(clear.throughCloud(clear.sun(), {1.0F, 2.0F, 3.0F}), 1.0F);
}

TEST(Weather, TheStandardOvercastHasItsIlluminanceAndShape) {
  for (const auto& [sun_deg, lux] : {std::pair{10.0, 3950.0}, {30.0, 10800.0}, {60.0, 18500.0}}) {
    const Daylight day = under(sun_deg, standardOvercast());
    EXPECT_NEAR(static_cast<double>(day.groundIlluminance().luminance()), lux, 0.01 * lux) << sun_deg;
    EXPECT_EQ(day.sun().illuminance.luminance(), 0.0F);
    const double zenith = static_cast<double>(day.skyLuminance({0.0F, 0.0F, 1.0F}).luminance());
    // CIE S 011 type 1: φ(90°) / φ(0°) = 1 / 2.986, and 0.7797 π L of level ground.
    EXPECT_NEAR(zenith / static_cast<double>(day.skyLuminance(towards(0.0)).luminance()), 2.986, 0.03);
    EXPECT_NEAR(lux / (kPi * zenith), 0.7797, 0.01);
  }
}

TEST(Weather, TheStandardOvercastGoesOnThroughTheHorizon) {
  double before = 0.0;
  for (double elevation = -1.0; elevation < 1.0; elevation += 0.02) {
    const auto lux =
        static_cast<double>(under(elevation, standardOvercast()).groundIlluminance().luminance());
    if (before > 0.0) {
      EXPECT_NEAR(lux / before, 1.0, 0.03) << elevation;
    }
    before = lux;
  }
}

TEST(Weather, AThickCoverHidesTheSunAndAThinOneDimsIt) {
  const float clear = usualAir().daylight({sunAt(40.0), 1.0}).sun().illuminance.luminance();
  EXPECT_EQ(under(40.0, covered(8.0)).sun().illuminance.luminance(), 0.0F);
  const double mu = std::sin(40.0 * kRadPerDeg);
  EXPECT_NEAR(static_cast<double>(under(40.0, covered(8.0, 2.0)).sun().illuminance.luminance() / clear),
              std::exp(-2.0 / mu), 1e-4);
}

TEST(Weather, ABlackBoardHasFivePercentContrastAtTheVisibility) {
  for (const double visibility : {60.0, 200.0, 5000.0}) {
    const Daylight day = under(35.0, fog(visibility));
    const auto contrast = [&](double distance_m) {
      const AirColumn air = day.airOver(towards(0.0, 20.0), static_cast<float>(distance_m));
      const float behind = day.skyLuminance(towards(0.0, 20.0)).luminance();
      return static_cast<double>((behind - LinearRgb(air.airlight).luminance()) / behind);
    };
    // The clear air's own extinction is by wavelength, and counted by its mean: 3 % of it.
    EXPECT_NEAR(contrast(visibility), 0.05, 0.003) << visibility;
    EXPECT_NEAR(contrast(0.5 * visibility), 0.2236, 0.006) << visibility;
    // No seam between what is far away and the sky.
    EXPECT_NEAR(contrast(30.0 * visibility), 0.0, 1e-3) << visibility;
  }
}

TEST(Weather, InDeepFogTheHorizonIsBetweenTheLightOfTheSkyAndOfTheGround) {
  for (const double albedo : {0.2, 0.8}) {
    AtmosphereOptions land;
    land.ground_albedo = albedo;
    Weather deep = fog(60.0);
    deep.fog_top_m = 3000.0;
    const Daylight day = albedo == 0.2 ? under(35.0, deep)  // the default
                                       : Atmosphere(land).daylight({sunAt(35.0), 1.0}, {}, deep);
    const double level = levelOf(day) / kPi;
    // Of light that is as bright from all above as from all below, (1 + A) / 2 of what level ground gets. But
    // where the fog ends, at the ground, it lets out less along the ground than up: 0.288 of its mean (see
    // droplets.cpp), not a half. So much of the 1 − A that the ground keeps, and A.
    for (const double azimuth : {0.0, 137.0, 317.0}) {
      const auto horizon = static_cast<double>(day.skyLuminance(towards(0.0, azimuth)).luminance());
      EXPECT_NEAR(horizon / level, albedo + 0.288 * (1.0 - albedo), 0.01) << albedo << ' ' << azimuth;
      EXPECT_LT(horizon / level, (1.0 + albedo) / 2.0) << albedo;
    }
    if (albedo > 0.5) {
      // What is left of the difference over bright ground.
      const auto horizon = static_cast<double>(day.skyLuminance(towards(0.0)).luminance());
      EXPECT_NEAR(horizon / level, (1.0 + albedo) / 2.0, 0.05 * (1.0 + albedo) / 2.0);
    }
  }
}

TEST(Weather, FogHidesTheLandBelowTheHorizonToo) {
  const auto luminance = [](const Weather& weather, double elevation_deg) {
    return static_cast<double>(under(35.0, weather).skyLuminance(towards(elevation_deg)).luminance());
  };
  // The land is looked at from 100 m up: at −5° it is 1,150 m away, behind seventeen times the optical depth
  // of fog of 200 m; without fog it is darker than the sky above it.
  const double sky = luminance(fog(200.0), 0.0);
  for (const double elevation : {-0.3, -1.0, -5.0})
    EXPECT_NEAR(luminance(fog(200.0), elevation), sky, 1e-3 * sky) << elevation;
  EXPECT_LT(luminance({}, -5.0), 0.9 * luminance({}, 0.0));
  // Of ground fog of 10 m a tenth of that way is left.
  Weather low = fog(200.0);
  low.fog_top_m = 10.0;
  const double behind = luminance(low, 0.0), land = luminance(low, -89.9), seen = luminance(low, -5.0);
  const double way_m = 100.0 / std::tan(5.0 * kRadPerDeg);
  EXPECT_NEAR((seen - behind) / (land - behind), std::exp(-std::log(20.0) / 200.0 * 0.1 * way_m), 0.03);
}

TEST(Weather, RainTakesHalfOfWhatItsDropsCover) {
  // Marshall & Palmer's drops cover π/4 ∫ N D² dD = π N₀ / (2 Λ³) of a path; twice that goes by geometric
  // optics, half of that still reaches a camera: 0.78 a kilometre at 10 mm/h.
  EXPECT_NEAR(rainPerMetre(10.0), 0.78e-3, 0.01e-3);
  Weather wet = standardOvercast();
  wet.rain_mm_per_h = 50.0;
  const Daylight rainy = under(35.0, wet), grey = under(35.0, standardOvercast());
  const auto passed = [](const Daylight& day) {
    return static_cast<double>(day.airOver(towards(0.0, 20.0), 800.0F).transmittance[1]);
  };
  EXPECT_NEAR(passed(rainy) / passed(grey), std::exp(-rainPerMetre(50.0) * 800.0), 1e-3);
  EXPECT_EQ(rainy.rain().mm_per_h, 50.0);
  EXPECT_EQ(grey.rain().mm_per_h, 0.0);
}

TEST(Weather, ALittleHazeMakesNoRainThinner) {
  Weather rainy = covered(8.0);
  rainy.rain_mm_per_h = 100.0;
  Weather hazy = rainy;
  hazy.visibility_m = 40000.0;
  const double rain = under(40.0, rainy).groundIlluminance().luminance();
  EXPECT_NEAR(under(40.0, hazy).groundIlluminance().luminance(), rain, 0.02 * rain);
}

std::string refused(const Weather& weather) {
  return messageOf([&] { under(30.0, weather); });
}

/// From the ground up.
double depthOf(const Fog& fog) {
  return static_cast<double>(fog.per_m) * static_cast<double>(fog.top_m);
}

TEST(Weather, RainAndFogTakeTogetherWhatEachDoes) {
  // A layer of fog 10 m high, and rain that takes more from above than that from some rate on: nothing jumps.
  for (const double mm_per_h : {0.5, 1.0, 2.5, 20.0}) {
    Weather both = fog(100.0), rain;
    both.fog_top_m = 10.0;
    const double of_fog = depthOf(under(40.0, both).fog());
    rain.rain_mm_per_h = both.rain_mm_per_h = mm_per_h;
    const double of_rain = depthOf(under(40.0, rain).fog());
    const Fog found = under(40.0, both).fog();
    EXPECT_NEAR(depthOf(found), of_rain + of_fog, 1e-5 * (of_rain + of_fog)) << mm_per_h;
    EXPECT_NEAR(static_cast<double>(found.per_m), of_rain / rain.cloud_base_m + of_fog / 10.0, 1e-7)
        << mm_per_h;
  }
}

TEST(Weather, FogThatIsNextToNothingIsSeenAsNothing) {
  // A metre less than the clear air's own range, which the refusal of a longer one tells: 5e-8 over 20 m.
  const std::string beyond = refused(fog(100000.0));
  const std::size_t number = beyond.find("less than the ");
  ASSERT_NE(number, std::string::npos) << beyond;
  Weather thin = fog(std::stod(beyond.substr(number + 14)) - 1.0);
  thin.fog_top_m = 10.0;
  const Daylight hazy = under(35.0, thin), clear = under(35.0, {});
  for (const double elevation_deg : {2.0, 30.0, 80.0}) {
    for (const float way_m : {3.0F, 500.0F}) {
      const Eigen::Array3f found = hazy.airOver(towards(elevation_deg), way_m).airlight;
      const Eigen::Array3f expected = clear.airOver(towards(elevation_deg), way_m).airlight;
      // Near the sun droplets send 6 / sr of its 1e5 lx.
      EXPECT_LT((found - expected).abs().maxCoeff(), 0.1F) << elevation_deg << " " << way_m;
    }
  }
}

TEST(Weather, WindNearTheGroundIsThatOfTheCloudsByThePowerLaw) {
  Weather weather;
  weather.wind_m_per_s = 10.0;  // from the west: to +x, and at 2 m 10 (2 / 1500)^(1/7) = 3.884 m/s
  EXPECT_LT((windNearGround(weather) - Eigen::Vector2d(3.884, 0.0)).norm(), 1e-3);
  weather.wind_from = Angle::degrees(0.0);
  weather.cloud_base_m = 200.0;  // from the north, 10 (1 / 100)^(1/7) = 5.179
  EXPECT_LT((windNearGround(weather) - Eigen::Vector2d(0.0, -5.179)).norm(), 1e-3);
  weather.rain_mm_per_h = 10.0;
  EXPECT_EQ(under(35.0, weather).rain().wind_m_s, windNearGround(weather));
}

TEST(Weather, FogThinsOutAboveItsTop) {
  Weather low = fog(150.0);
  low.fog_top_m = 20.0;
  const Daylight day = under(35.0, low);
  const AirColumn up = day.airOver(towards(60.0), 5000.0F);
  const AirColumn clear = usualAir().daylight({sunAt(35.0), 1.0}).airOver(towards(60.0), 5000.0F);
  const double depth = -std::log(0.05) / 150.0 * 20.0 / std::sin(60.0 * kRadPerDeg);
  EXPECT_NEAR(static_cast<double>(up.transmittance[1] / clear.transmittance[1]), std::exp(-depth), 0.01);
}

/// Fog of 200 m and 30 m high, over ground at 300 m, seen from a height above that.
Daylight lowFogFrom(float height_m) {
  Weather low = fog(200.0);
  low.fog_top_m = 30.0;
  return under(35.0, low).overGround(300.0F).seenFrom({7.0F, -5.0F, 300.0F + height_m});
}

TEST(Weather, FogIsLookedDownOnFromAboveIt) {
  const Daylight high = lowFogFrom(120.0F), clear = usualAir().daylight({sunAt(35.0), 1.0});
  const Eigen::Vector3f down = towards(-90.0), slope = towards(-30.0), up = towards(30.0);
  const double depth = 30.0 * static_cast<double>(high.fog().per_m);
  const auto passed = [&](const Eigen::Vector3f& way, float distance_m) {
    return static_cast<double>(high.airOver(way, distance_m).transmittance[1] /
                               clear.airOver(way, distance_m).transmittance[1]);
  };
  // Of 120 m straight down 30 lie in fog: e^-0.45 = 0.64 with the clear air's haze. Singles, of numbers near
  // 100.
  EXPECT_NEAR(passed(down, 120.0F), std::exp(-depth), 1e-4);
  EXPECT_NEAR(passed(slope, 240.0F), std::exp(-2.0 * depth), 1e-4);
  EXPECT_EQ(passed(slope, 179.0F), 1.0);
  for (const float distance_m : {100.0F, 1e4F, std::numeric_limits<float>::infinity()}) {
    EXPECT_TRUE((high.airOver(up, distance_m).airlight == clear.airOver(up, distance_m).airlight).all());
    EXPECT_TRUE((high.airOver(towards(0.0), distance_m).transmittance ==
                 clear.airOver(towards(0.0), distance_m).transmittance)
                    .all());
  }
  for (const double elevation : {0.0, 5.0, 60.0})
    EXPECT_TRUE(
        (high.skyLuminance(towards(elevation)).value == clear.skyLuminance(towards(elevation)).value).all());
  EXPECT_TRUE((high.sunSeen().illuminance.value == clear.sun().illuminance.value).all());
  EXPECT_LT(high.sun().illuminance.luminance(), 0.5F * clear.sun().illuminance.luminance());
}

TEST(Weather, FogOfAnEyeAtItsGroundIsTheWholeLayer) {
  Weather low = fog(200.0);
  low.fog_top_m = 30.0;
  const Daylight whole = under(35.0, low);
  // Also in a hollow.
  for (const float height_m : {0.0F, -40.0F}) {
    const Daylight here = lowFogFrom(height_m);
    EXPECT_EQ(here.fog().top_m, whole.fog().top_m);
    for (const double elevation : {-50.0, -3.0, 0.0, 3.0, 50.0}) {
      const Eigen::Vector3f way = towards(elevation);
      EXPECT_TRUE((here.skyLuminance(way).value == whole.skyLuminance(way).value).all()) << elevation;
      EXPECT_TRUE((here.airOver(way, 90.0F).airlight == whole.airOver(way, 90.0F).airlight).all())
          << elevation;
    }
    // Shares of cover and fog one after another, and both at once: the last digit.
    EXPECT_NEAR(here.sunSeen().illuminance.luminance() / whole.sun().illuminance.luminance(), 1.0F, 1e-6F);
  }
}

TEST(Weather, NothingJumpsAsAnEyeLeavesTheFog) {
  // By 2 mm about its top: of 0.015 a metre, 0.1 % of light at 1°, 0.1 mm of rounding at 330 m.
  const Daylight below = lowFogFrom(29.999F), above = lowFogFrom(30.001F);
  const auto ratio = [](float a, float b) { return a / b; };
  const float fog_luminance = below.skyLuminance(towards(0.0)).luminance();
  for (const double elevation : {-90.0, -20.0, -1.0, 1.0, 20.0, 90.0}) {
    const Eigen::Vector3f way = towards(elevation);
    EXPECT_NEAR(ratio(below.skyLuminance(way).luminance(), above.skyLuminance(way).luminance()), 1.0F, 3e-3F)
        << elevation;
    for (const float distance_m : {5.0F, 60.0F, 3000.0F}) {
      const AirColumn from_below = below.airOver(way, distance_m),
                      from_above = above.airOver(way, distance_m);
      EXPECT_NEAR(from_below.transmittance[1], from_above.transmittance[1], 3e-3F) << elevation;
      EXPECT_NEAR(from_below.airlight[1], from_above.airlight[1], 3e-3F * fog_luminance) << elevation;
    }
  }
  EXPECT_NEAR(ratio(below.sunSeen().illuminance.luminance(), above.sunSeen().illuminance.luminance()), 1.0F,
              1e-3F);
}

TEST(Weather, LandFarBelowIsSeenThroughTheClearAirAboveFogToo) {
  // Towards the horizon the sky above it, then fog, whose own horizon is another.
  const Daylight high = lowFogFrom(500.0F), clear = usualAir().daylight({sunAt(35.0), 1.0});
  const float horizon = clear.skyLuminance(towards(0.0)).luminance();
  EXPECT_NEAR(high.skyLuminance(towards(-0.02)).luminance(), horizon, 0.01F * horizon);
}

TEST(Weather, CloudMapsCoverExactlyTheOktasAskedFor) {
  for (const double oktas : {0.5, 3.0, 7.9}) {
    const CloudMap map(oktas, 20.0, 4);
    const auto cells = static_cast<double>(map.cells().size());
    const auto cloudy =
        std::count_if(map.cells().begin(), map.cells().end(), [](float depth) { return depth > 0.0F; });
    EXPECT_NEAR(static_cast<double>(cloudy), oktas / 8.0 * cells, 1.0);
    double sum = 0.0, passed = 0.0;
    for (const float depth : map.cells()) {
      sum += static_cast<double>(depth);
      passed += std::exp(-static_cast<double>(depth) / 0.6);
    }
    EXPECT_NEAR(sum / static_cast<double>(cloudy), 20.0, 0.01);
    EXPECT_NEAR(map.meanPassed(0.6), passed / cells, 1e-4);
  }
  EXPECT_EQ(CloudMap(3.0, 20.0, 4).cells(), CloudMap(3.0, 20.0, 4).cells());
  EXPECT_NE(CloudMap(3.0, 20.0, 4).cells(), CloudMap(3.0, 20.0, 5).cells());
}

/// Over many places: of the direct light in parts of the clear hour's.
double meanOverPlaces(const std::function<double(const Eigen::Vector3f&)>& value) {
  double sum = 0.0;
  constexpr int kSide = 40;
  for (int i = 0; i < kSide * kSide; ++i) {
    // An even spread over one period of the map.
    sum += value({static_cast<float>(i % kSide) * 256.0F, static_cast<float>(i / kSide) * 256.0F, 0.0F});
  }
  return sum / (kSide * kSide);
}

TEST(Weather, TheMeanBelowBrokenCloudIsThatOfThePublishedFit) {
  // Kasten & Czeplak 1980: of the clear hour's illuminance 1 − 0.75 (N / 8)^3.4, of Hamburg's clouds, whose
  // depth is not ours; measured elsewhere it lies up to 0.15 to either side.
  // Of the sun's height the fit knows nothing. A flat cloud does: of a sun at 15° it lets through 3/7 (1 + 2
  // sin h) = 0.65, of one at 40° 0.98 of what it does of even light; and nothing enters by its sides, which
  // the low sun lights.
  for (const double sun_deg : {15.0, 40.0, 60.0}) {
    const double clear = levelOf(usualAir().daylight({sunAt(sun_deg), 1.0}));
    for (const double oktas : {2.0, 4.0, 6.0, 7.0, 8.0}) {
      const Daylight day = under(sun_deg, covered(oktas));
      if (oktas < 8.0) {
        const double sun = meanOverPlaces([&](const Eigen::Vector3f& place) {
          return static_cast<double>(day.throughCloud(day.sun(), place));
        });
        // 1600 samples of patches that are km wide.
        EXPECT_NEAR(sun, 1.0, 0.08) << oktas << " at " << sun_deg;
      }
      const double band = sun_deg < 30.0 ? 0.19 : 0.15;
      EXPECT_NEAR(levelOf(day) / clear, 1.0 - 0.75 * std::pow(oktas / 8.0, 3.4), band)
          << oktas << " at " << sun_deg;
    }
  }
}

/// Which way the shadows go that a wind from there moves, unit.
struct Wind {
  double from_deg;
  Eigen::Vector3f way;
};

TEST(Weather, ShadowsMoveWithTheWind) {
  const Wind winds[] = {{270.0, {1.0F, 0.0F, 0.0F}},
                        {0.0, {0.0F, -1.0F, 0.0F}},
                        // Towards 20°: sin 20°, cos 20°.
                        {200.0, {0.34202F, 0.93969F, 0.0F}}};
  for (const Wind& wind : winds) {
    for (const double stamp_s : {0.0, 1.7e9}) {
      Weather weather = covered(4.0);
      weather.wind_m_per_s = 8.0;
      weather.wind_from = Angle::degrees(wind.from_deg);
      weather.clock_s = stamp_s;
      const Daylight now = under(50.0, weather);
      weather.clock_s = stamp_s + 60.0;
      const Daylight later = under(50.0, weather);
      int differ = 0;
      for (int i = 0; i < 100; ++i) {
        const Eigen::Vector3f place(static_cast<float>(i) * 70.0F, static_cast<float>(i) * 31.0F, 0.0F);
        const float before = now.throughCloud(now.sun(), place);
        // Drifts are of whole millimetres, and floats leave half of one of places 7 km away; light changes by
        // less than 1 a metre.
        EXPECT_NEAR(before, later.throughCloud(later.sun(), place + 480.0F * wind.way), 2e-3F)
            << wind.from_deg << ' ' << stamp_s;
        differ += std::abs(before - later.throughCloud(later.sun(), place)) > 0.5F ? 1 : 0;
      }
      EXPECT_GT(differ, 10) << wind.from_deg << ' ' << stamp_s;
    }
  }
}

TEST(Weather, WhereTheSunIsSeenItShines) {
  constexpr double kSun_deg = 50.0;
  const Daylight day = under(kSun_deg, covered(4.0));
  const float clear = usualAir().daylight({sunAt(kSun_deg), 1.0}).skyLuminance(towards(kSun_deg)).luminance();
  int bright = 0, dark = 0;
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector3f place(static_cast<float>(i) * 170.0F, static_cast<float>(i) * 41.0F, 0.0F);
    const float through = day.throughCloud(day.sun(), place);
    const float beside = day.seenFrom(place).skyLuminance(towards(kSun_deg)).luminance();
    if (through > 1.9F) {
      ++bright;
      EXPECT_NEAR(beside, clear, 0.2F * clear) << i;
    } else if (through < 0.2F && through > 0.002F) {
      // Where little light comes through, droplets stand before the sun, and most of what they turn goes on
      // nearly straight: at slant depths of 2 to 7 far more than the clear air's aureole.
      ++dark;
      EXPECT_GT(beside, 1.5F * clear) << i;
    }
  }
  EXPECT_GT(bright, 100);
  EXPECT_GT(dark, 10);
}

TEST(Weather, WhatCannotBeIsRefused) {
  EXPECT_EQ(refused(covered(9.0)), "cover is 9, but must be from 0 to 8 oktas");
  EXPECT_EQ(refused(covered(1e-30)), "cover is 1e-30, but must be 0 or from 0.01 to 8 oktas");
  Weather drizzle;
  drizzle.rain_mm_per_h = 1e-15;
  EXPECT_EQ(refused(drizzle), "rain is 1e-15, but must be 0 or from 0.001 to 200 mm/h");
  Weather coverless;
  coverless.overcast = Overcast::kCie;
  EXPECT_EQ(refused(coverless), "cover is 0, but must be 8 where overcast is cie, which is a closed sky");
  Weather cie = standardOvercast();
  cie.cover_oktas = 6.0;
  EXPECT_EQ(refused(cie), "cover is 6, but must be 8 where overcast is cie, which is a closed sky");
  cie = standardOvercast();
  cie.optical_depth = 3.0;
  EXPECT_EQ(refused(cie), "optical_depth is 3, but must be auto where overcast is cie, which has none");
  EXPECT_NE(refused(fog(100000.0)).find("that the clear air of this turbidity has"), std::string::npos);
  EXPECT_NE(refused(fog(std::nan(""))).find("visibility is nan"), std::string::npos);
}

TEST(Weather, IsJudgedBeforeAnythingIsMadeAsTheAirWouldJudgeIt) {
  const auto refusal = [](const Weather& weather, const AtmosphereOptions& air) {
    return messageOf([&] { validate(weather, air); });
  };
  for (const double turbidity : {2.0, 4.0}) {
    AtmosphereOptions air;
    air.turbidity = turbidity;
    const std::string beyond = refusal(fog(100000.0), air);
    if (turbidity == 2.0) {  // that of the usual air
      EXPECT_EQ(beyond, refused(fog(100000.0)));
    }
    const std::string least = "less than the ";
    ASSERT_NE(beyond.find(least), std::string::npos) << beyond;
    const double clear_m = std::stod(beyond.substr(beyond.find(least) + least.size()));
    EXPECT_EQ(refusal(fog(clear_m - 1.0), air), "");
    EXPECT_NE(refusal(fog(clear_m + 1.0), air), "");
    air.observer_height_m = 3000.0;
    EXPECT_EQ(refusal(fog(clear_m + 1.0), air), "") << "one sees farther in thin air";
  }
  Weather coverless;
  coverless.overcast = Overcast::kCie;
  EXPECT_NE(refusal(coverless, {}), "");
}

}  // namespace
}  // namespace sunlit::sky
