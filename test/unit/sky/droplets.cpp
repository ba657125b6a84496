/// Light through layers of droplets: energy, symmetry, and light paths traced through the same layer.
#include "sky/droplets.h"

#include <gtest/gtest.h>

#include <cmath>

#include "path_traced_layer.h"
#include "sky/hemisphere.h"
#include "sky/layer_sky.h"

namespace sunlit::sky {
namespace {

const Droplets& droplets() {
  static const Droplets shared;
  return shared;
}

DiscLight sunAt(double elevation_deg, float illuminance = 1.0F) {
  return {Direction(Azimuth::degrees(90.0), Angle::degrees(elevation_deg)), kSunRadiusAtOneAu,
          LinearRgb(illuminance, illuminance, illuminance), std::nullopt};
}

const auto kNothing = [](const Eigen::Vector3f&) { return Eigen::Array3f(Eigen::Array3f::Zero()); };

float levelOf(const LayerSky& sky,
              const std::function<Eigen::Array3f(const Eigen::Vector3f&)>& straight = kNothing) {
  const auto pieces = hemisphere(Eigen::Vector2f::UnitX());
  return LinearRgb(levelIlluminance(pieces,
                                    [&](const Eigen::Vector3f& towards) {
                                      return Eigen::Array3f(sky.scattered(towards) +
                                                            straight(towards) * sky.passed(towards.z()));
                                    }))
      .luminance();
}

TEST(Droplets, WhatIsNotThrownBackOfEvenLightComesThrough) {
  for (const double depth : {0.01, 0.3, 1.0, 7.0, 30.0, 100.0, 800.0}) {
    const DropletLayer layer(droplets(), depth);
    const LightAbove even{{}, [](const Eigen::Vector3f&) { return Eigen::Array3f(Eigen::Array3f::Ones()); }};
    const LayerSky sky(layer, even, 0.0F);
    const float through = levelOf(sky, even.luminance) / static_cast<float>(kPi);
    // Droplets take nothing. 0.4 %: rows of the table, summed over pieces of the sky.
    EXPECT_NEAR(through + layer.sphericalAlbedo(), 1.0F, 0.004F) << depth;
  }
}

TEST(Droplets, AThickLayerLetsThroughWhatDiffusionTheorySays) {
  // Kokhanovsky & Nauss 2006 (ACP 6, 5537): 1 / (1.07 + 0.75 (1 − g) τ), for even light within 2 % at τ ≥ 10.
  // The tables end at 362.
  for (const double depth : {10.0, 20.0, 50.0, 100.0, 350.0, 512.0, 800.0}) {
    const DropletLayer layer(droplets(), depth);
    const double expected = 1.0 / (1.07 + 0.75 * (1.0 - kDropletAsymmetry) * depth);
    // Doubling a layer again and again loses 0.23 % of the light up to 350.
    const double lost = depth > 100.0 ? 0.0025 : 0.0;
    EXPECT_NEAR(1.0 - static_cast<double>(layer.sphericalAlbedo()), expected, 0.03 * expected + lost)
        << depth;
  }
}

struct Case {
  double depth, sun_deg, albedo;
};

class TracedLayer : public ::testing::TestWithParam<Case> {};

TEST_P(TracedLayer, IsMet) {
  const auto [depth, sun_deg, albedo] = GetParam();
  const DropletLayer layer(droplets(), depth);
  const DiscLight sun = sunAt(sun_deg);
  const LayerSky sky(layer, {{sun}, kNothing}, static_cast<float>(albedo));
  PathTracedLayer traced(depth, sun.towards.vector(), albedo);
  for (const auto& [elevation, azimuth] :
       {std::pair{88.0, 10.0}, {60.0, 90.0}, {30.0, 250.0}, {8.0, 120.0}, {sun_deg - 4.0, 94.0}}) {
    const Eigen::Vector3d towards = Direction(Azimuth::degrees(azimuth), Angle::degrees(elevation)).vector();
    const auto expected = traced.luminance(towards, 40000);
    const auto found = static_cast<double>(LinearRgb(sky.scattered(towards.cast<float>())).luminance());
    // 2 %: between rows and columns of the table; and three standard errors.
    EXPECT_NEAR(found, expected.mean, 0.02 * expected.mean + 3.0 * expected.error)
        << "optical depth " << depth << ", sun at " << sun_deg << ", seen at " << elevation << ", "
        << azimuth;
  }
}

INSTANTIATE_TEST_SUITE_P(Depths, TracedLayer,
                         ::testing::Values(Case{0.2, 50.0, 0.0}, Case{1.0, 50.0, 0.0}, Case{3.0, 20.0, 0.0},
                                           Case{10.0, 35.0, 0.0}, Case{40.0, 60.0, 0.0},
                                           Case{40.0, 10.0, 0.0}, Case{10.0, 35.0, 0.8}));

TEST(Droplets, AThickLayerIsDarkestAlongItsEdge) {
  // From straight up to the horizon, black ground below: 3/7 (1 + 2 μ) of the mean would fall by 3 : 1.
  // Forward scattering takes more of it off at the last, since what comes from below is black.
  constexpr double kSun_deg = 35.0, kAlongGround_deg = 0.2;
  const DropletLayer layer(droplets(), 20.0);
  const DiscLight sun = sunAt(kSun_deg);
  const LayerSky sky(layer, {{sun}, kNothing}, 0.0F);
  const Eigen::Vector3d along = Direction(Azimuth::degrees(250.0), Angle::degrees(kAlongGround_deg)).vector();
  const auto traced = PathTracedLayer(20.0, sun.towards.vector(), 0.0).luminance(along, 800000);
  const auto found = static_cast<double>(LinearRgb(sky.scattered(along.cast<float>())).luminance());
  EXPECT_NEAR(found, traced.mean, 0.02 * traced.mean + 3.0 * traced.error);
  EXPECT_NEAR(found * kPi / static_cast<double>(levelOf(sky)), 0.29, 0.01);  // 3/7 without that
}

TEST(Droplets, LightGoesBackAndForthBetweenSnowAndCloud) {
  const DropletLayer layer(droplets(), 50.0);
  const DiscLight sun = sunAt(40.0, 100000.0F);
  const float over_grass = levelOf(LayerSky(layer, {{sun}, kNothing}, 0.2F));
  const float over_snow = levelOf(LayerSky(layer, {{sun}, kNothing}, 0.85F));
  // By hand: (1 − 0.2 (1 − t)) / (1 − 0.85 (1 − t)) with t = 1 / (1.07 + 0.75 · 0.14 · 50) = 0.158.
  EXPECT_NEAR(over_snow / over_grass, 2.93F, 0.06F);
}

}  // namespace
}  // namespace sunlit::sky
