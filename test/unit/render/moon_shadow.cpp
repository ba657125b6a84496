// Where only the moon shines, it casts the shadows, and they lie where a ruler says.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/usual_air.h"
#include "test_scenes.h"

namespace sunlit::test {
namespace {

constexpr float kSide_m = 1.0f;  // of a cube on the ground, centred at the origin
constexpr double kHeight_m = 12.0;
constexpr int kSize_px = 240;

/// The sun deep below the horizon, opposite to where a full moon stands, if there is one.
sky::Daylight nightOpposite(const Direction& moon, bool is_there) {
  sky::NightSky night;
  if (is_there) night.moon = sky::MoonInSky{moon, moon, 384400e3, Angle()};
  return sky::usualAir().daylight({Direction(-moon.vector()), 1.0}, night);
}

/// Whether the way from `from` towards the moon, given by its direction, meets the cube grown by `by_m` on
/// all sides but the ground's: the slab method, on paper.
bool cubeHides(const Eigen::Vector3d& from, const Eigen::Vector3d& towards, double by_m) {
  const double half = 0.5 * static_cast<double>(kSide_m) + by_m;
  double enters = 0.0, leaves = 1e9;
  const Eigen::Vector3d low(-half, -half, -1.0), high(half, half, static_cast<double>(kSide_m) + by_m);
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (low[axis] - from[axis]) / towards[axis], b = (high[axis] - from[axis]) / towards[axis];
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  return enters < leaves;
}

class MoonShadow : public testing::TestWithParam<double> {};

TEST_P(MoonShadow, LiesAwayFromTheMoonWithinAPixel) {
  scene::Scene scene;
  const Eigen::Array3f albedo = Eigen::Array3f::Constant(0.5f);
  const int paint = addMaterial(&scene, albedo);
  addGround(&scene, paint, 50.0f);
  addBlock(&scene, paint, {-0.5f * kSide_m, -0.5f * kSide_m, 0.0f}, {kSide_m, kSide_m, kSide_m});
  const render::RenderOptions options = smallCamera(kSize_px, kSize_px, 30.0);
  render::Renderer renderer(shared(scene), options);
  const Eigen::Isometry3d map_from_optical = lookingAt({0.0, 0.0, kHeight_m}, {0.0, 0.0, 0.0});
  renderer.look(map_from_optical);

  const Direction moon(Azimuth::degrees(GetParam()), Angle::degrees(35.0));
  const sky::Daylight day = nightOpposite(moon, true);
  ASSERT_EQ(day.sun().illuminance.luminance(), 0.0f);
  const image::LinearImage picture = renderer.light(day);
  const Eigen::Vector3d towards = moon.vector();
  const float sky_only = skyPart(day, Eigen::Vector3f::UnitZ(), albedo)[1];
  const float moon_part =
      albedo[1] / kPiFloat * day.moon().illuminance.value[1] * static_cast<float>(towards.z());
  EXPECT_GT(moon_part, 3.0f * sky_only);  // else this would not be a test of the moon

  // A pixel shows 2.7 cm of the ground; the moon's disc blurs the edge of a shadow that falls 1.74 m far by
  // ±1.4 cm along the ground. So a pixel from the edge all is decided.
  const double pixel_m = kHeight_m / options.camera.fx;
  int lit = 0, dark = 0;
  for (int y = 0; y < kSize_px; ++y) {
    for (int x = 0; x < kSize_px; ++x) {
      const Eigen::Vector3d ray =
          map_from_optical.linear() * Eigen::Vector3d((x - options.camera.cx) / options.camera.fx,
                                                      (y - options.camera.cy) / options.camera.fy, 1.0);
      const Eigen::Vector3d ground = map_from_optical.translation() - ray * (kHeight_m / ray.z());
      if (cubeHides(map_from_optical.translation(), ray, pixel_m)) continue;  // shows the cube itself
      const float light = at(picture, x, y)[1];
      if (cubeHides(ground, towards, -pixel_m)) {
        ++dark;
        ASSERT_LT(light, sky_only + 0.2f * moon_part) << ground.transpose();
      } else if (!cubeHides(ground, towards, pixel_m)) {
        ++lit;
        ASSERT_GT(light, sky_only + 0.8f * moon_part) << ground.transpose();
      }
    }
  }
  // The shadow is 1 m wide or, from a corner, 1.41 m, and 1.43 m long: more than a square metre of it is
  // seen.
  EXPECT_GT(dark, 1.0 / (pixel_m * pixel_m));
  EXPECT_GT(lit, kSize_px * kSize_px / 2);
}

INSTANTIATE_TEST_SUITE_P(FromAllSides, MoonShadow, testing::Values(20.0, 120.0, 225.0, 310.0));

TEST(MoonShadow, IsNotThereWithoutAMoon) {
  // Without a moon the ground is as bright on either side of the cube. A renderer without a bake does not
  // know that the cube hides a part of the sky.
  scene::Scene scene;
  const int paint = addMaterial(&scene, Eigen::Array3f::Constant(0.5f));
  addGround(&scene, paint, 50.0f);
  addBlock(&scene, paint, {-0.5f, -0.5f, 0.0f}, {1.0f, 1.0f, 1.0f});
  render::Renderer renderer(shared(scene), smallCamera(64, 64, 30.0));
  renderer.look(lookingAt({0.0, 0.0, kHeight_m}, {0.0, 0.0, 0.0}));
  const image::LinearImage picture =
      renderer.light(nightOpposite(Direction(Azimuth::degrees(120.0), Angle::degrees(35.0)), false));
  const float far_side = at(picture, 60, 32)[1], near_side = at(picture, 4, 32)[1];
  EXPECT_GT(near_side, 0.0f);  // airglow
  for (int x = 0; x < 64; ++x) {
    if (std::abs(x - 32) < 8) continue;  // the cube
    EXPECT_NEAR(at(picture, x, 32)[1], 0.5f * (near_side + far_side), 0.05f * near_side) << x;
  }
}

}  // namespace
}  // namespace sunlit::test
