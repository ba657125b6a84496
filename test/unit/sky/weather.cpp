/// Cloud and fog against published numbers and what can be worked out on paper.
#include "sunlit/sky/weather.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "clear_air.h"
#include "sky/cie_sky.h"
#include "sky/cloud_map.h"

namespace sunlit::sky {
namespace {

Direction sunAt(double elevation_deg, double azimuth_deg = 137.0) {
  return Direction(Azimuth::degrees(azimuth_deg), Angle::degrees(elevation_deg));
}

Eigen::Vector3f towards(double elevation_deg, double azimuth_deg = 137.0) {
  return sunAt(elevation_deg, azimuth_deg).vector().cast<float>();
}

Daylight under(double sun_deg, const Weather& weather) {
  return clearAir().daylight({sunAt(sun_deg), 1.0}, {}, weather);
}

Weather covered(double oktas, std::optional<double> optical_depth = std::nullopt) {
  Weather weather;
  weather.cover_oktas = oktas;
  weather.optical_depth = optical_depth;
  return weather;
}

Weather standardOvercast() {
  Weather weather = covered(8.0);
  weather.overcast = Overcast::kCie;
  return weather;
}

Weather fog(double visibility_m) {
  Weather weather;
  weather.visibility_m = visibility_m;
  return weather;
}

TEST(Weather, WithoutAnyTheSkyIsTheClearOneToTheBit) {
  const Daylight clear = clearAir().daylight({sunAt(35.0), 1.0});
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
  const float clear = clearAir().daylight({sunAt(40.0), 1.0}).sun().illuminance.luminance();
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

TEST(Weather, FogThinsOutAboveItsTop) {
  Weather low = fog(150.0);
  low.fog_top_m = 20.0;
  const Daylight day = under(35.0, low);
  const AirColumn up = day.airOver(towards(60.0), 5000.0F);
  const AirColumn clear = clearAir().daylight({sunAt(35.0), 1.0}).airOver(towards(60.0), 5000.0F);
  const double depth = -std::log(0.05) / 150.0 * 20.0 / std::sin(60.0 * kRadPerDeg);
  EXPECT_NEAR(static_cast<double>(up.transmittance[1] / clear.transmittance[1]), std::exp(-depth), 0.01);
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
  const double clear =
      static_cast<double>(clearAir().daylight({sunAt(40.0), 1.0}).groundIlluminance().luminance());
  for (const double oktas : {2.0, 4.0, 6.0, 7.0, 8.0}) {
    const Daylight day = under(40.0, covered(oktas));
    const double sun = meanOverPlaces([&](const Eigen::Vector3f& place) {
      return static_cast<double>(day.throughCloud(day.sun(), place));
    });
    if (oktas < 8.0) {
      EXPECT_NEAR(sun, 1.0, 0.08) << oktas;
    }  // 1600 samples of patches that are km wide
    const double found = static_cast<double>(day.groundIlluminance().luminance()) / clear;
    EXPECT_NEAR(found, 1.0 - 0.75 * std::pow(oktas / 8.0, 3.4), 0.15) << oktas;
  }
}

TEST(Weather, ShadowsMoveWithTheWind) {
  Weather weather = covered(4.0);
  weather.wind_m_per_s = 8.0;
  weather.wind_from = Angle::degrees(270.0);  // so that they move east
  const Daylight now = under(50.0, weather);
  weather.clock_s = 60.0;
  const Daylight later = under(50.0, weather);
  bool differ = false;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3f place(static_cast<float>(i) * 70.0F, static_cast<float>(i) * 31.0F, 0.0F);
    const Eigen::Vector3f moved = place + Eigen::Vector3f(480.0F, 0.0F, 0.0F);
    EXPECT_NEAR(now.throughCloud(now.sun(), place), later.throughCloud(later.sun(), moved), 1e-3F);
    differ = differ ||
             std::abs(now.throughCloud(now.sun(), place) - later.throughCloud(later.sun(), place)) > 0.5F;
  }
  EXPECT_TRUE(differ);
}

TEST(Weather, WhereTheSunIsSeenItShines) {
  const Daylight day = under(50.0, covered(4.0));
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3f place(static_cast<float>(i) * 170.0F, 0.0F, 0.0F);
    // Where no light comes through, a bright cloud stands before the sun; and the other way about.
    const float through = day.throughCloud(day.sun(), place);
    const float beside = day.seenFrom(place).skyLuminance(towards(50.0)).luminance();
    const float clear = clearAir().daylight({sunAt(50.0), 1.0}).skyLuminance(towards(50.0)).luminance();
    if (through > 1.9F) {
      EXPECT_NEAR(beside, clear, 0.2F * clear) << i;
    }
  }
}

TEST(Weather, WhatCannotBeIsRefused) {
  const auto refused = [](const Weather& weather) {
    try {
      under(30.0, weather);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused(covered(9.0)), "cover is 9, but must be from 0 to 8 oktas");
  Weather cie = standardOvercast();
  cie.cover_oktas = 6.0;
  EXPECT_EQ(refused(cie), "cover is 6, but must be 8 where overcast is cie, which is a closed sky");
  cie = standardOvercast();
  cie.optical_depth = 3.0;
  EXPECT_EQ(refused(cie), "optical_depth is 3, but must be auto where overcast is cie, which has none");
  EXPECT_NE(refused(fog(100000.0)).find("that the clear air of this turbidity has"), std::string::npos);
  EXPECT_NE(refused(fog(std::nan(""))).find("visibility is nan"), std::string::npos);
}

}  // namespace
}  // namespace sunlit::sky
