// Shade that lets a known share of the sun through.
#include <gtest/gtest.h>

#include <cmath>

#include "test_scenes.h"

namespace sunlit::test {
namespace {

constexpr int kWidth = 96, kHeight = 72;
constexpr double kElevation_deg = 50.0;

image::LinearImage rendered(const scene::Scene& scene) {
  render::Renderer renderer(shared(scene), smallCamera(kWidth, kHeight, 60.0));
  renderer.look(lookingAt({0.0, -3.0, 2.0}, {0.0, 0.0, 0.0}));
  return renderer.light(daylightAt(180.0, kElevation_deg));
}

scene::Scene ground() {
  scene::Scene scene;
  addGround(&scene, addMaterial(&scene, Eigen::Array3f::Constant(0.5f)), 30.0f);
  return scene;
}

/// Boards across the way to the sun, 60 m off and `open` of the screen apart. The disc is 0.56 m wide there,
/// as wide as 11 boards, so that what is open of it changes from place to place by less than a fifth.
void addScreen(scene::Scene* scene, float open) {
  constexpr float kPeriod_m = 0.05f, kHalfWidth_m = 15.0f;
  const auto elevation = static_cast<float>(Angle::degrees(kElevation_deg).rad());
  const Eigen::Vector3f sun(0.0f, -std::cos(elevation), std::sin(elevation));
  const Eigen::Vector3f along = Eigen::Vector3f::UnitX(), up = sun.cross(along);
  const Eigen::Vector3f middle = 60.0f * sun;
  for (int i = -160; i < 160; ++i) {
    addPatch(scene, 0, middle - kHalfWidth_m * along + kPeriod_m * static_cast<float>(i) * up,
             2.0f * kHalfWidth_m * along, (1.0f - open) * kPeriod_m * up);
  }
}

class ScreenFarOff : public testing::TestWithParam<float> {};

TEST_P(ScreenFarOff, LetsItsShareOfTheSunThrough) {
  scene::Scene screened = ground(), hidden = ground();
  addScreen(&screened, GetParam());
  addScreen(&hidden, -0.01f);
  const image::LinearImage lit = rendered(ground()), half = rendered(screened), dark = rendered(hidden);
  double sum = 0.0, square = 0.0;
  int count = 0;
  // Away from the border of the picture, where there are fewer neighbours.
  for (int y = 12; y < kHeight - 12; ++y) {
    for (int x = 12; x < kWidth - 12; ++x) {
      const float share = (half.at(x, y)[1] - dark.at(x, y)[1]) / (lit.at(x, y)[1] - dark.at(x, y)[1]);
      sum += static_cast<double>(share);
      square += std::pow(static_cast<double>(share - GetParam()), 2.0);
      ++count;
    }
  }
  const double open = static_cast<double>(GetParam());
  // 3,500 pixels of at least half a ray each have a standard deviation of 2.4 % of a ray's.
  const double of_one_ray = std::sqrt(open * (1.0 - open));
  EXPECT_NEAR(sum / count, open, 3.0 * 0.024 * of_one_ray);
  // Rays to 16 points have 25 %; some of what is found here is what really changes from place to place.
  EXPECT_LT(std::sqrt(square / count), 0.2 * of_one_ray);
}

INSTANTIATE_TEST_SUITE_P(DeepShadeAndHalf, ScreenFarOff, testing::Values(0.03f, 0.3f, 0.6f));

}  // namespace
}  // namespace sunlit::test
