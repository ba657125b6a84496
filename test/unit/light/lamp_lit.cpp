// Surfaces close to lamps, or to what shines, so bright that they light others as lamps do.
#include "light/bake/samples/looked_for.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>

#include "night_scene.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

TEST(LampLitSurfaces, OfAHandsWidthLightTheGroundBelow) {
  // A white square of 0.2 m, 0.3 m above a lamp 4 m up, over black ground.
  scene::Scene scene;
  scene.materials = {paint(0.0f), paint(0.8f)};
  addGround(&scene, 0, 40.0f);
  addPatch(&scene, 1, {-0.1f, -0.1f, 4.3f}, {0.0f, 0.2f, 0.0f}, {0.2f, 0.0f, 0.0f});
  scene.lamps = {lampAt({0.0f, 0.0f, 4.0f}, 100.0f)};
  const World world = baked(std::move(scene));
  for (const double x : {0.0, 2.0, 5.0}) {
    double expected = 0.0;
    constexpr int kAcross = 20;
    for (int i = 0; i < kAcross; ++i) {
      for (int k = 0; k < kAcross; ++k) {
        const double px = 0.2 * (i + 0.5) / kAcross - 0.1, py = 0.2 * (k + 0.5) / kAcross - 0.1;
        const double to_lamp = std::sqrt(px * px + py * py + 0.09);
        const double lit = 100.0 * 0.3 / (to_lamp * to_lamp * to_lamp);
        const double square = (px - x) * (px - x) + py * py + 4.3 * 4.3;
        expected += albedoOf(0.8f) / kPi * lit * 0.04 / (kAcross * kAcross) * 4.3 * 4.3 / (square * square);
      }
    }
    // Met by rays, of which each stands for 0.04 sr, the square of 0.002 sr would give nothing or 20 times
    // it. What it mirrors, 5 % of its light, counts as if it were diffuse.
    EXPECT_NEAR(illuminance(world, {static_cast<float>(x), 0.0f, 0.0f}), expected, 0.05 * expected) << x;
  }
}

/// Each within `worst`, all within half of that on average.
void expectAbout(const World& world, const std::vector<Looked>& points, double worst) {
  const std::vector<double> fast = pictured(world, points), slow = tracedWithLamps(world, points, 60000);
  double mean = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(fast[i] / slow[i], 1.0, worst) << points[i].position.transpose();
    mean += std::abs(fast[i] / slow[i] - 1.0) / static_cast<double>(points.size());
  }
  EXPECT_LT(mean, 0.5 * worst);
}

TEST(LampLitSurfaces, OfARoomLightTheGroundBeforeItsWindow) {
  // A white room of 4 × 4 × 2.6 m with a window of 1.2 × 1.1 m; the lamp itself shines on the ground straight
  // before it alone.
  scene::Scene scene;
  scene.materials = {paint(0.35f), paint(0.7f)};
  addGround(&scene, 0, 60.0f);
  for (const auto& [low, size] :
       {std::pair(Eigen::Vector3f(-2.2f, 4.0f, 0.0f), Eigen::Vector3f(4.4f, 0.2f, 2.6f)),
        std::pair(Eigen::Vector3f(-2.2f, 0.0f, 0.0f), Eigen::Vector3f(0.2f, 4.0f, 2.6f)),
        std::pair(Eigen::Vector3f(2.0f, 0.0f, 0.0f), Eigen::Vector3f(0.2f, 4.0f, 2.6f)),
        std::pair(Eigen::Vector3f(-2.2f, -0.2f, 2.6f), Eigen::Vector3f(4.4f, 4.4f, 0.2f)),
        std::pair(Eigen::Vector3f(-2.2f, -0.2f, 0.0f), Eigen::Vector3f(1.6f, 0.2f, 2.6f)),
        std::pair(Eigen::Vector3f(0.6f, -0.2f, 0.0f), Eigen::Vector3f(1.6f, 0.2f, 2.6f)),
        std::pair(Eigen::Vector3f(-0.6f, -0.2f, 0.0f), Eigen::Vector3f(1.2f, 0.2f, 1.0f)),
        std::pair(Eigen::Vector3f(-0.6f, -0.2f, 2.1f), Eigen::Vector3f(1.2f, 0.2f, 0.5f))})
    addBlock(&scene, 1, low, size);
  scene.lamps = {lampAt({0.0f, 2.0f, 2.2f}, 500.0f)};
  std::vector<Looked> points;
  for (const auto& [x, y] : {std::pair(-1.5f, -2.0f), std::pair(1.5f, -2.0f), std::pair(0.0f, -0.9f),
                             std::pair(-1.5f, -3.0f), std::pair(1.5f, -3.0f), std::pair(2.0f, -3.0f)})
    points.push_back({{x, y, 0.0f}, kUp, {0.0f, 0.6f, 0.8f}});
  // Measured 12 % on average, 25 % at worst, of which the noise of the traced paths is a part: beside the
  // pool of the lamp itself they find a fifth of what is there. As met by rays alone: 51 % on average.
  expectAbout(baked(std::move(scene)), points, 0.32);
}

TEST(LampLitSurfaces, AboveAPanelThatShinesUpwardsLightTheGroundBelow) {
  scene::Scene scene;
  scene.materials = {paint(0.3f), paint(0.8f), paint(0.0f, 5000.0f)};
  scene.materials[2].double_sided = false;
  addGround(&scene, 0, 40.0f);
  addBlock(&scene, 1, {-0.3f, -0.3f, 4.3f}, {0.6f, 0.6f, 0.02f});
  addPatch(&scene, 2, {-0.1f, -0.1f, 4.0f}, {0.2f, 0.0f, 0.0f}, {0.0f, 0.2f, 0.0f});
  std::vector<Looked> points;
  for (const float distance : {0.45f, 2.0f, 3.0f, 4.5f}) {
    for (int i = 0; i < 6; ++i) {
      const float around = 0.2f + static_cast<float>(i) * kPiFloat / 3.0f;
      points.push_back(
          {{distance * std::cos(around), distance * std::sin(around), 0.0f}, kUp, {0.0f, 0.6f, 0.8f}});
    }
  }
  // Measured 8 % on average, 26 % at worst: what of the plate the panel hides is told by few rays, at nodes
  // some distance apart. As met by rays alone: 59 % on average.
  expectAbout(baked(std::move(scene)), points, 0.3);
}

TEST(LampLitSurfaces, AreLookedForTheMoreTheFartherOffTheyAre) {
  EXPECT_EQ(lookedFor(0.5f * kFarthestLit_m), 1.0f);
  EXPECT_EQ(lookedFor(kFarthestLit_m), 0.0f);
  EXPECT_EQ(lookedForFrom(0.5f, 0.4f), 0.0f);
  EXPECT_NEAR(lookedForFrom(0.5f, 0.75f), 0.5f, 1e-6f);
  EXPECT_EQ(lookedForFrom(0.5f, 2.0f), 1.0f);
  EXPECT_EQ(lookedForFrom(0.0f, 0.0f), 1.0f);  // what shines by itself
}

}  // namespace
}  // namespace sunlit::light
