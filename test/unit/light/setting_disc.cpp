// A sun that the horizon cuts.
#include <gtest/gtest.h>

#include "light/patches/disc_above_horizon.h"
#include "paper_scene.h"
#include "sunlit/light/illumination.h"

namespace sunlit::light {
namespace {

constexpr double kSunRadius_rad = 0.2666 * kRadPerDeg;

Eigen::Vector3f atElevation(double elevation_rad) {
  return Eigen::Vector3d(0.0, std::cos(elevation_rad), std::sin(elevation_rad)).cast<float>();
}

TEST(DiscAboveHorizon, KeepsAWholeDisc) {
  const DiscAboveHorizon above(atElevation(1.1 * kSunRadius_rad), kSunRadius_rad);
  EXPECT_EQ(above.place({0.3, -0.9}), Eigen::Vector2d(0.3, -0.9));
}

TEST(DiscAboveHorizon, PressesAHalfDiscEvenly) {
  const DiscAboveHorizon above(atElevation(0.0), kSunRadius_rad);
  const Eigen::Vector2d edge = above.place({0.0, -1.0}), top = above.place({0.0, 1.0});
  EXPECT_NEAR(edge.y(), 0.0, 1e-9);
  EXPECT_NEAR(top.y(), 1.0, 1e-9);
  // The middle parts the upper half disc in two halves: at the height whose segment is a quarter of the disc.
  const double y = above.place({0.0, 0.0}).y();
  EXPECT_NEAR(0.5 - (y * std::sqrt(1.0 - y * y) + std::asin(y)) / kPi, 0.25, 1e-9);
  // What was on the rim stays there.
  EXPECT_NEAR(above.place({0.6, -0.8}).norm(), 1.0, 1e-9);
}

TEST(SettingSun, LightsAWallByAllOfItThatIsAboveTheHorizon) {
  const auto world = [](bool with_ground) {
    scene::Scene scene;
    scene.materials = {paint(0.5f)};
    addPatch(&scene, 0, {-6.0f, 0.0f, 0.0f}, {12.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 3.0f});
    if (with_ground)
      addPatch(&scene, 0, {-900.0f, -900.0f, 0.0f}, {1800.0f, 0.0f, 0.0f}, {0.0f, 900.0f, 0.0f});
    return worldOf(std::move(scene));
  };
  const World walled = world(true), alone = world(false);
  const Eigen::Vector3f south = -Eigen::Vector3f::UnitY();
  const std::vector<Looked> points(16, {{0.3f, 0.0f, 0.5f}, south, south});
  const auto fast = [&](const World& of, const sky::Daylight& day) {
    return rowValues(rowOf(points, *of.geometry->scene), of, illumination(of, day));
  };
  for (const double elevation_deg : {0.3, 0.15, 0.0, -0.15, -0.25}) {
    const sky::Daylight day = onlySun(180.0, elevation_deg);
    const std::vector<double> expected = fast(alone, day), found = fast(walled, day);
    const double truth = traced(walled, {points[0]}, day, 4000, 0)[0];
    EXPECT_GT(expected[0], 0.1);
    // The illuminance is that of the part above the horizon: the ground, of which it meets none, takes
    // nothing.
    for (std::size_t i = 0; i < points.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-6) << elevation_deg;
    // 0.1 %: the sun is higher by half of its width.
    EXPECT_NEAR(truth, expected[0], 1e-3 * expected[0]) << elevation_deg;
  }
}

}  // namespace
}  // namespace sunlit::light
