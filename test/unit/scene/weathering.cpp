// Water and snow on surfaces, by numbers on paper.
#include "sunlit/scene/weathering.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sunlit/quantity/angle.h"
#include "sunlit/scene/shelter.h"

namespace sunlit::scene {
namespace {

const Eigen::Vector3f kUp = Eigen::Vector3f::UnitZ();

/// A rectangle at a height, seen from above.
Mesh level(float x, float y, float side_m, float height_m) {
  Mesh mesh;
  for (const auto& [right, far] : {std::pair{0.0f, 0.0f}, {side_m, 0.0f}, {side_m, side_m}, {0.0f, side_m}})
    mesh.positions.emplace_back(x + right, y + far, height_m);
  mesh.normals.assign(4, kUp);
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// 100 m of ground, with a roof of 10 m in its middle, 3 m up.
Scene roofedGround() {
  Scene scene;
  scene.materials.resize(1);
  scene.meshes = {level(-50.0f, -50.0f, 100.0f, 0.0f), level(-5.0f, -5.0f, 10.0f, 3.0f)};
  return scene;
}

Weathering weathered(const Scene& scene, const SurfaceState& state) {
  return {Shape(scene), scene.materials, state};
}

Weathering::Look dryLook(float albedo, float roughness = 0.9f) {
  return {Eigen::Array3f::Constant(albedo), kUp, roughness, 0.0f};
}

Weathering::Look seen(const Weathering& weathering, const Eigen::Vector3f& position,
                      const Eigen::Vector3f& face = kUp, float albedo = 0.2f) {
  Weathering::Look look = dryLook(albedo);
  weathering.apply({position, face, 0.01f}, Material(), &look);
  return look;
}

SurfaceState state(double wet, double puddles, double snow_m, int seed = 0) {
  SurfaceState state;
  state.wet = wet;
  state.puddles = puddles;
  state.snow_m = snow_m;
  state.seed = seed;
  return state;
}

TEST(Wet, ASoakedSurfaceIsAsDarkAsLeknerAndDorfFound) {
  const Weathering soaked = weathered(roofedGround(), state(1.0, 0.0, 0.0));
  for (const double albedo : {0.05, 0.1, 0.2, 0.3, 0.5}) {
    const auto look = seen(soaked, {20.0f, 20.0f, 0.0f}, kUp, static_cast<float>(albedo));
    // Absorbed: (1 − R) a / (1 − p (1 − a)), a = 1 − ρ; the film mirrors R, the rest is scattered. What is
    // scattered first gets through the film, which shading takes off.
    const double a = 1.0 - albedo, r = 1.0 / 49.0, p = 1.0 - (1.0 - 0.0664) * 9.0 / 16.0;
    const double scattered = 1.0 - r - (1.0 - r) * a / (1.0 - p * (1.0 - a));
    EXPECT_NEAR((1.0 - r) * static_cast<double>(look.albedo[0]), scattered, 1e-5) << albedo;
    EXPECT_EQ(look.film, 1.0f);
    EXPECT_LT(look.roughness, 0.4f);
  }
}

TEST(Wet, ASoakedSurfaceHasThePublishedShareOfItsDryLight) {
  // (1 − R) (1 − p) / (1 − p ρ) with R = 0.0204 and p = 0.4749, worked out by hand: what is scattered,
  // without what the film mirrors, in parts of ρ.
  constexpr struct {
    double albedo, share;
  } kPublished[] = {{0.05, 0.5269}, {0.1, 0.5400}, {0.2, 0.5684}, {0.3, 0.5998}, {0.5, 0.6745}};
  const Weathering soaked = weathered(roofedGround(), state(1.0, 0.0, 0.0));
  for (const auto& [albedo, share] : kPublished) {
    const auto look = seen(soaked, {20.0f, 20.0f, 0.0f}, kUp, static_cast<float>(albedo));
    const double through_film = 1.0 - static_cast<double>(Weathering::kFilmReflectance);
    EXPECT_NEAR(through_film * static_cast<double>(look.albedo[0]) / albedo, share, 1e-3) << albedo;
  }
}

TEST(Wet, WhatSendsBackEverythingStillDoes) {
  const Weathering soaked = weathered(roofedGround(), state(1.0, 0.0, 0.0));
  EXPECT_NEAR(seen(soaked, {20.0f, 20.0f, 0.0f}, kUp, 1.0f).albedo[0], 1.0f, 1e-6f);
}

TEST(Wet, BelowARoofItIsDryAndOnItWet) {
  const Weathering soaked = weathered(roofedGround(), state(1.0, 0.5, 0.1));
  const auto below = seen(soaked, {0.0f, 0.0f, 0.0f});
  EXPECT_EQ(below.albedo[0], 0.2f);
  EXPECT_EQ(below.roughness, 0.9f);
  EXPECT_EQ(below.film, 0.0f);
  EXPECT_NEAR(seen(soaked, {0.0f, 0.0f, 3.0f}).albedo[0], Weathering::kSnowAlbedo, 1e-3f);
  EXPECT_EQ(seen(soaked, {0.0f, 0.0f, 3.0f}, -kUp).albedo[0], 0.2f);
}

TEST(Wet, LeavesHoldNoFilmAndLetRainThrough) {
  Scene scene = roofedGround();
  scene.materials.push_back(Material());
  scene.materials[1].transmission = 0.3f;
  scene.meshes[1].material = 1;
  const Weathering soaked = weathered(scene, state(1.0, 0.0, 0.0));
  EXPECT_EQ(seen(soaked, {0.0f, 0.0f, 0.0f}).film, 1.0f);
  Weathering::Look leaf = dryLook(0.2f);
  soaked.apply({{0.0f, 0.0f, 3.0f}, kUp, 0.01f}, scene.materials[1], &leaf);
  EXPECT_EQ(leaf.albedo[0], 0.2f);
  EXPECT_EQ(leaf.roughness, dryLook(0.2f).roughness);
  EXPECT_EQ(leaf.film, 0.0f);
}

TEST(Wet, AWallUnderTheSkyIsHalfWetAndARoofedOneDry) {
  Scene scene = roofedGround();
  const Weathering soaked = weathered(scene, state(1.0, 0.0, 0.0));
  const Eigen::Vector3f north = Eigen::Vector3f::UnitY();
  EXPECT_NEAR(seen(soaked, {0.0f, 5.0f, 2.0f}, north).film, 0.5f,
              1e-3f);  // below the roof's edge, facing out
  EXPECT_EQ(seen(soaked, {0.0f, 0.0f, 2.0f}, north).film, 0.0f);
}

/// Of places a bit more than a wavelength apart, the share that `what` holds for.
template <typename What>
double shareOf(const Weathering& weathering, const What& what) {
  int count = 0, all = 0;
  for (float x = -49.0f; x < 49.0f; x += 0.37f) {
    for (float y = -49.0f; y < 49.0f; y += 0.37f) {
      if (std::abs(x) < 6.0f && std::abs(y) < 6.0f) continue;
      ++all;
      if (what(seen(weathering, {x, y, 0.0f}))) ++count;
    }
  }
  return static_cast<double>(count) / all;
}

TEST(Shelter, IsUnderRoofs) {
  const Scene scene = roofedGround();
  const Shelter shelter(Shape(scene), scene.materials);
  EXPECT_FALSE(shelter.open({0.0, 0.0, 1.0}));
  EXPECT_FALSE(shelter.open({0.0, 0.0, 2.95}));  // just below the sheet, which has no thickness
  EXPECT_TRUE(shelter.open({0.0, 0.0, 3.2}));
  EXPECT_TRUE(shelter.open({20.0, 20.0, 0.5}));
  EXPECT_TRUE(shelter.open({5.4, 0.0, 0.5}));    // beside it
  EXPECT_TRUE(shelter.open({900.0, 0.0, 0.5}));  // beyond the world
}

TEST(Puddles, CoverTheShareAskedFor) {
  for (const double share : {0.05, 0.2, 0.5}) {
    const Weathering flooded = weathered(roofedGround(), state(0.0, share, 0.0));
    // Of the ground that is there; under the roof it is dry.
    EXPECT_NEAR(shareOf(flooded, [](const auto& look) { return look.film > 0.5f; }), share, 0.03) << share;
  }
}

TEST(Puddles, LieElsewhereByAnotherSeedAndInTheSamePlacesByTheSame) {
  const Weathering one = weathered(roofedGround(), state(0.0, 0.3, 0.0, 1));
  const Weathering same = weathered(roofedGround(), state(0.0, 0.3, 0.0, 1));
  const Weathering other = weathered(roofedGround(), state(0.0, 0.3, 0.0, 2));
  int differ = 0;
  for (float x = 7.0f; x < 49.0f; x += 0.5f) {
    EXPECT_EQ(seen(one, {x, 3.0f, 0.0f}).film, seen(same, {x, 3.0f, 0.0f}).film);
    differ += seen(one, {x, 3.0f, 0.0f}).film != seen(other, {x, 3.0f, 0.0f}).film ? 1 : 0;
  }
  EXPECT_GT(differ, 20);  // of 84
}

TEST(Puddles, AreFlatAndNotOnSlopes) {
  const Weathering flooded = weathered(roofedGround(), state(0.0, 0.9, 0.0));
  Weathering::Look rough = dryLook(0.2f);
  rough.normal = Eigen::Vector3f(0.3f, 0.0f, 0.95f).normalized();
  const Eigen::Vector3f slope = Eigen::Vector3f(0.2f, 0.0f, 1.0f).normalized();
  int standing = 0;
  for (float x = 7.0f; x < 49.0f; x += 0.5f) {
    Weathering::Look look = rough;
    flooded.apply({{x, 3.0f, 0.0f}, kUp, 0.01f}, Material(), &look);
    if (look.film == 1.0f) {
      EXPECT_NEAR(look.normal.z(), 1.0f, 1e-6f);
    }
    standing += look.film == 1.0f ? 1 : 0;
    EXPECT_EQ(seen(flooded, {x, 3.0f, 0.0f}, slope).film, 0.0f);
  }
  EXPECT_GT(standing, 60);  // of 84
}

/// 64 m of ground in waves of 8 m that are 6 cm high, crests at 0, ±8 m …: its slopes are 1.35° at most.
Scene waves() {
  Scene scene;
  scene.materials.resize(1);
  Mesh mesh;
  constexpr int kSteps = 256;
  for (int i = 0; i <= kSteps; ++i) {
    const float x = 0.25f * static_cast<float>(i - kSteps / 2);
    for (const float y : {-32.0f, 32.0f})
      mesh.positions.emplace_back(x, y, 0.03f * std::cos(2.0f * kPiFloat * x / 8.0f));
    if (i == 0) continue;
    const auto last = static_cast<std::uint32_t>(mesh.positions.size()) - 1;
    mesh.triangles.push_back({last - 3, last - 1, last});
    mesh.triangles.push_back({last - 3, last, last - 2});
  }
  mesh.normals.assign(mesh.positions.size(), kUp);
  scene.meshes = {mesh};
  return scene;
}

TEST(Puddles, GatherInHollows) {
  const Weathering flooded = weathered(waves(), state(0.0, 0.3, 0.0));
  int places = 0, wet = 0, in_hollows = 0, on_crests = 0;
  for (float x = -31.0f; x < 31.0f; x += 0.31f) {
    for (float y = -31.0f; y < 31.0f; y += 0.31f) {
      const float height_m = 0.03f * std::cos(2.0f * kPiFloat * x / 8.0f);
      ++places;
      if (seen(flooded, {x, y, height_m}).film < 0.5f) continue;
      ++wet;
      in_hollows += height_m < -0.015f ? 1 : 0;  // a third of the ground
      on_crests += height_m > 0.015f ? 1 : 0;    // another third
    }
  }
  // As much as asked for, by what 60 000 places of 250 waves of noise leave to chance.
  EXPECT_NEAR(wet, 0.3 * places, 0.02 * places);
  EXPECT_GT(in_hollows, 0.7 * wet);
  EXPECT_LT(on_crests, 0.03 * wet);
}

TEST(Puddles, DoNotKnowOfWallsBesideThem) {
  Scene walled = roofedGround();
  walled.meshes[1] = level(0.0f, -50.0f, 0.5f, 2.0f);  // the top of a wall on the ground beside it
  const Weathering beside = weathered(walled, state(0.0, 0.3, 0.0));
  const Weathering without = weathered(roofedGround(), state(0.0, 0.3, 0.0));
  int differ = 0;
  for (float y = -49.0f; y < -6.0f; y += 0.5f)
    differ +=
        (seen(beside, {1.5f, y, 0.0f}).film > 0.5f) != (seen(without, {1.5f, y, 0.0f}).film > 0.5f) ? 1 : 0;
  // By the threshold alone, which less ground moves a little.
  EXPECT_LT(differ, 6);  // of 86
}

TEST(Snow, CoversTheShareOfYangAndLiesOnWhatFacesUp) {
  for (const double depth_m : {0.005, 0.02, 0.1}) {
    const Weathering snowed = weathered(roofedGround(), state(0.0, 0.0, depth_m));
    const double share = std::tanh(depth_m / 0.025);
    EXPECT_NEAR(shareOf(snowed, [](const auto& look) { return look.albedo[0] > 0.55f; }), share, 0.03)
        << depth_m;
  }
  const Weathering deep = weathered(roofedGround(), state(0.0, 0.0, 0.3));
  EXPECT_NEAR(seen(deep, {20.0f, 20.0f, 0.0f}).albedo[0], 0.9f, 1e-6f);
  const auto tilted = [](double degrees) {
    return Eigen::Vector3d(std::sin(degrees * kRadPerDeg), 0.0, std::cos(degrees * kRadPerDeg))
        .cast<float>()
        .eval();
  };
  EXPECT_NEAR(seen(deep, {20.0f, 20.0f, 0.0f}, tilted(39.0)).albedo[0], 0.9f, 1e-6f);
  EXPECT_EQ(seen(deep, {20.0f, 20.0f, 0.0f}, tilted(61.0)).albedo[0], 0.2f);
}

TEST(Snow, FromFarAwayThereIsItsShare) {
  const Weathering snowed = weathered(roofedGround(), state(0.0, 0.0, 0.02));
  Weathering::Look look = dryLook(0.2f);
  snowed.apply({{20.0f, 20.0f, 0.0f}, kUp, 50.0f}, Material(), &look);
  EXPECT_NEAR(static_cast<double>(look.albedo[0]), 0.2 + std::tanh(0.8) * 0.7, 1e-5);
}

TEST(SurfaceState, IsRefusedOutOfRangeByName) {
  EXPECT_NO_THROW(validate(state(1.0, 0.9, 0.5)));
  for (const auto& bad : {state(1.1, 0.0, 0.0), state(0.0, 1.0, 0.0), state(0.0, 0.0, -0.1)})
    EXPECT_THROW(validate(bad), std::invalid_argument);
  EXPECT_TRUE(isDry(SurfaceState()));
  EXPECT_TRUE(state(0.0, 0.0, 0.0, 3) == SurfaceState());
  EXPECT_FALSE(state(0.0, 0.2, 0.0, 3) == state(0.0, 0.2, 0.0));
}

}  // namespace
}  // namespace sunlit::scene
