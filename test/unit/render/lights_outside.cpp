// What shines on a camera from beside its picture: by how much, from where, and what hides it.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "sunlit/image/veiling_glare.h"
#include "sunlit/light/illumination.h"
#include "sunlit/sky/uniform_sky.h"
#include "test_scenes.h"

namespace sunlit::test {
namespace {

constexpr float kSun_lx = 1e5f;
const Eigen::Vector3d kEye(0.0, 0.0, 2.0);

/// Ground, and a wall to the right of a camera that looks along x: all that is below 45 degrees up there lies
/// behind it.
scene::Scene groundAndWall() {
  scene::Scene scene;
  const int paint = addMaterial(&scene, Eigen::Array3f::Constant(0.5f));
  addGround(&scene, paint, 50.0f);
  addBlock(&scene, paint, {-40.0f, -6.0f, 0.0f}, {80.0f, 1.0f, 7.0f});
  return scene;
}

/// 60 degrees across, 47 down, level, along x (east).
class LightsOutside : public testing::Test {
 protected:
  LightsOutside() : renderer_(shared(groundAndWall()), smallCamera(640, 480)) {
    renderer_.look(lookingAt(kEye, kEye + Eigen::Vector3d::UnitX()));
  }

  /// The sun to the left of the axis.
  static sky::Daylight sunAt(double left_deg, double up_deg) {
    sky::UniformSky sky;
    sky.sun.towards = Direction(Azimuth::degrees(90.0 - left_deg), Angle::degrees(up_deg));
    sky.sun.illuminance = LinearRgb(kSun_lx, kSun_lx, kSun_lx);
    return sky::uniformDaylight(sky);
  }
  float illuminance(const light::Illumination& light) const {
    float sum = 0.0f;
    for (const image::LightOutside& outside : renderer_.lightsOutside(light))
      sum += outside.illuminance.value[1];
    return sum;
  }

  render::Renderer renderer_;
};

TEST_F(LightsOutside, AreNotThoseInThePicture) {
  EXPECT_TRUE(renderer_.lightsOutside(sunAt(0.0, 10.0)).empty());
  EXPECT_TRUE(renderer_.lightsOutside(sunAt(29.7, 1.0)).empty());
  EXPECT_TRUE(renderer_.lightsOutside(sunAt(0.0, 23.1)).empty());
}

TEST_F(LightsOutside, AreToldOfByWhereTheyStandBeforeTheCamera) {
  const auto lights = renderer_.lightsOutside(sunAt(40.0, 0.5));
  ASSERT_EQ(lights.size(), 1u);
  EXPECT_EQ(lights[0].illuminance.value[1], kSun_lx);
  const double left = 40.0 * kRadPerDeg, up = 0.5 * kRadPerDeg;
  const Eigen::Vector3d expected(-std::sin(left) * std::cos(up), -std::sin(up),
                                 std::cos(left) * std::cos(up));
  EXPECT_LT((lights[0].towards - expected).norm(), 1e-6);
  EXPECT_EQ(illuminance(sunAt(150.0, 20.0)), kSun_lx);  // behind it
}

TEST_F(LightsOutside, AreCutByTheEdgeOfThePicture) {
  // The whole sun is 0.533 degrees wide, a pixel at the edge 0.08: with its middle on the edge, half of it is
  // out. 64 points and their steps: 3 %.
  EXPECT_NEAR(illuminance(sunAt(30.0, 1.0)), 0.5f * kSun_lx, 0.04f * kSun_lx);
  float before = 0.0f;
  for (double left_deg = 29.6; left_deg < 30.4; left_deg += 0.05) {
    const float now = illuminance(sunAt(left_deg, 1.0));
    EXPECT_GE(now, before);
    EXPECT_LE(now - before, 0.2f * kSun_lx);
    before = now;
  }
  EXPECT_EQ(before, kSun_lx);
}

TEST_F(LightsOutside, AreHiddenByWalls) {
  EXPECT_EQ(illuminance(sunAt(-90.0, 44.0)), 0.0f);
  EXPECT_EQ(illuminance(sunAt(-90.0, 46.0)), kSun_lx);
  // The wall's upper edge stands 5 m above the camera and 5 m away.
  EXPECT_NEAR(illuminance(sunAt(-90.0, 45.0)), 0.5f * kSun_lx, 0.04f * kSun_lx);
}

/// Of 100 cd.
scene::Lamp lampAt(const Eigen::Vector3f& position) {
  scene::Lamp lamp;
  lamp.position = position;
  lamp.intensity = LinearRgb(100.0f, 100.0f, 100.0f);
  return lamp;
}

light::Illumination nightWith(const std::vector<scene::Lamp>& lamps) {
  sky::UniformSky dark;
  light::Illumination night(sky::uniformDaylight(dark));
  night.lamps = std::make_shared<const std::vector<scene::Lamp>>(lamps);
  return night;
}

TEST_F(LightsOutside, AreLampsToo) {
  // To the left, behind the wall.
  const auto lights =
      renderer_.lightsOutside(nightWith({lampAt({0.0f, 10.0f, 2.0f}), lampAt({0.0f, -10.0f, 2.0f})}));
  ASSERT_EQ(lights.size(), 1u);
  EXPECT_NEAR(lights[0].illuminance.value[1], 1.0, 1e-5);  // 100 cd at 10 m
  EXPECT_LT((lights[0].towards + Eigen::Vector3d::UnitX()).norm(), 1e-6);
}

TEST_F(LightsOutside, AreLampsInThePictureThatItDoesNotShow) {
  // The second one behind the wall, the others on both sides of the picture's left edge.
  const auto at = [](double left_deg) {
    return lampAt({static_cast<float>(10.0 * std::cos(left_deg * kRadPerDeg)),
                   static_cast<float>(10.0 * std::sin(left_deg * kRadPerDeg)), 2.0f});
  };
  EXPECT_NEAR(illuminance(nightWith({at(0.0)})), 1.0, 1e-5);
  EXPECT_EQ(illuminance(nightWith({lampAt({20.0f, -9.0f, 2.0f})})), 0.0f);
  const render::RenderOptions& options = renderer_.options();
  image::GlareOptions glare;
  glare.share = 0.03;
  const image::VeilingGlare veil(image::Vignetting(image::Lens(options.camera, options.distortion), {}),
                                 glare);
  const auto meanOf = [&](double left_deg) {
    float mean = 0.0f;
    for (const image::LightOutside& light : renderer_.lightsOutside(nightWith({at(left_deg)})))
      mean += veil.meanOf(light).value[1];
    return mean;
  };
  const float before = meanOf(30.02);
  EXPECT_GT(before, 0.0f);
  EXPECT_NEAR(meanOf(29.98), before, 0.01f * before);
}

TEST_F(LightsOutside, AreNotSeenThroughWallsAlsoWhereTheyLightWhatIsBehindThem) {
  scene::Lamp lamp = lampAt({0.0f, -10.0f, 2.0f});
  lamp.casts_shadows = false;
  EXPECT_EQ(illuminance(nightWith({lamp})), 0.0f);
  lamp.position.y() = 10.0f;
  EXPECT_NEAR(illuminance(nightWith({lamp})), 1.0, 1e-5);
}

/// One in the picture and one to the left of it, each in a bulb that glows while lamps of its group burn.
scene::Scene withBulbs() {
  scene::Scene scene = groundAndWall();
  const int glass = addMaterial(&scene, Eigen::Array3f::Constant(0.5f));
  scene.materials.back().emission = LinearRgb(1e4f, 1e4f, 1e4f);
  scene.materials.back().lamp_group = "bulbs";
  addBlock(&scene, glass, {9.9f, -0.1f, 1.9f}, {0.2f, 0.2f, 0.2f});
  addBlock(&scene, glass, {-0.1f, 9.9f, 1.9f}, {0.2f, 0.2f, 0.2f});
  return scene;
}

TEST_F(LightsOutside, AreNotLampsWhoseBulbsAreInThePicture) {
  render::Renderer renderer(shared(withBulbs()), renderer_.options());
  renderer.look(lookingAt(kEye, kEye + Eigen::Vector3d::UnitX()));
  const auto luxOf = [&](scene::Lamp lamp, const char* group) {
    lamp.group = group;
    lamp.casts_shadows = false;
    float sum = 0.0f;
    for (const image::LightOutside& light : renderer.lightsOutside(nightWith({lamp})))
      sum += light.illuminance.value[1];
    return sum;
  };
  const scene::Lamp seen = lampAt({10.0f, 0.0f, 2.0f}), beside = lampAt({0.0f, 10.0f, 2.0f}),
                    below = lampAt({10.0f, 0.0f, 1.7f});
  EXPECT_EQ(luxOf(seen, "bulbs"), 0.0f);
  EXPECT_NEAR(luxOf(beside, "bulbs"), 1.0, 1e-5);
  EXPECT_EQ(luxOf(below, "bulbs"), 0.0f);  // the way to it passes below its bulb
  EXPECT_NEAR(luxOf(below, "others"), 1.0, 2e-3);
  EXPECT_EQ(luxOf(seen, "others"), 0.0f);  // in a dark box
}

TEST_F(LightsOutside, ShineEvenlyThroughWhatBlendsEvenly) {
  scene::Scene scene = groundAndWall();
  const int veil = addMaterial(&scene, Eigen::Array3f::Constant(0.5f));
  scene.materials.back().alpha_mode = scene::AlphaMode::kBlend;
  scene.materials.back().alpha = 0.5f;
  addPatch(&scene, veil, {-50.0f, 5.0f, 0.0f}, {100.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 80.0f});
  render::Renderer renderer(shared(std::move(scene)), renderer_.options());
  const light::Illumination lamp = nightWith({lampAt({0.0f, 10.0f, 2.0f})});
  for (double x = 0.0; x < 0.1; x += 0.01) {
    const Eigen::Vector3d eye = kEye + x * Eigen::Vector3d::UnitX();
    renderer.look(lookingAt(eye, eye + Eigen::Vector3d::UnitX()));
    for (const auto& [light, lux] :
         {std::pair(lamp, 1.0f), std::pair(light::Illumination(sunAt(60.0, 30.0)), kSun_lx)}) {
      const auto lights = renderer.lightsOutside(light);
      ASSERT_EQ(lights.size(), 1u) << x;
      EXPECT_NEAR(lights[0].illuminance.value[1], 0.5f * lux, 1e-4f * lux) << x;
    }
  }
}

TEST_F(LightsOutside, InThePictureAreInItsPixelsWithAllTheirLight) {
  // What veiling glare takes the mean of: nothing is cut off at what a display shows.
  const image::LinearImage with = renderer_.light(sunAt(0.0, 12.0)),
                           without = renderer_.light(sunAt(0.0, -12.0));
  const image::PinholeCamera& camera = renderer_.options().camera;
  double sum = 0.0;
  for (int y = 60; y < 180; ++y) {
    for (int x = 260; x < 380; ++x) {
      const Eigen::Vector3d ray = camera.unproject({1.0 * x, 1.0 * y});
      sum += static_cast<double>(with.at(x, y)[1] - without.at(x, y)[1]) /
             (camera.fx * camera.fy * std::pow(ray.norm(), 3));
    }
  }
  EXPECT_NEAR(sum, static_cast<double>(kSun_lx),
              0.01 * static_cast<double>(kSun_lx));  // as DiscInView has it
}

}  // namespace
}  // namespace sunlit::test
