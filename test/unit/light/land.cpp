#include "sunlit/light/land.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "paper_scene.h"

namespace sunlit::light {
namespace {

/// What a level ground of that colour sends back, as a Lambertian share and the few per cent that its face
/// mirrors: by the reflectance that pictures use, seen at 50°.
double sentBack(const scene::Material& material) {
  return albedoTowards(material, Eigen::Vector3f(std::sqrt(1.0f - 0.64f * 0.64f), 0.0f, 0.64f));
}

/// Places, rounding, and the quadrature of the other side.
constexpr double kRough = 0.004;

double landOf(const scene::Scene& scene) {
  return albedoFromAbove(worldOf(scene)).value();
}

TEST(Land, OfSnowIsAsBrightAsSnow) {
  scene::Scene scene;
  scene.materials = {paint(0.8f)};
  addGround(&scene, 0, 50.0f);
  EXPECT_NEAR(landOf(scene), sentBack(scene.materials[0]), kRough);
  EXPECT_NEAR(landOf(scene), 0.8, 0.03);
}

TEST(Land, OfNothingIsUnknown) {
  EXPECT_FALSE(albedoFromAbove(worldOf(scene::Scene())));
  scene::Scene wall;
  wall.materials = {paint(0.5f)};
  addPatch(&wall, 0, {0, 0, 0}, {1, 0, 0}, {0, 0, 1});
  EXPECT_FALSE(albedoFromAbove(worldOf(wall)));
}

TEST(Land, HasTheLevelOfMostOfWhatIsSeenFromAbove) {
  scene::Scene scene;
  scene.materials = {paint(0.5f)};
  EXPECT_EQ(worldOf(scene).ground_m, 0.0f);
  addPatch(&scene, 0, {0, 0, 300}, {100, 0, 0}, {0, 100, 0});
  addPatch(&scene, 0, {0, 0, 320}, {40, 0, 0}, {0, 100, 0});      // roofs
  addPatch(&scene, 0, {-200, 0, 250}, {200, 0, 0}, {0, 0, 150});  // a wall
  addPatch(&scene, 0, {0, 0, -900}, {100, 0, 0}, {0, 100, 0});    // nobody sees it
  // Singles of shares that add up to 1, times 300.
  EXPECT_NEAR(worldOf(scene).ground_m, 300.0f, 1e-3f);
}

TEST(Land, IsTheMeanByLevelArea) {
  scene::Scene scene;
  scene.materials = {paint(0.1f), paint(0.7f)};
  addPatch(&scene, 0, {0, 0, 0}, {30, 0, 0}, {0, 10, 0});
  addPatch(&scene, 1, {30, 0, 0}, {10, 0, 25}, {0, 10, 0});  // a steep slope: a quarter of the level area
  const double expected = 0.75 * sentBack(scene.materials[0]) + 0.25 * sentBack(scene.materials[1]);
  EXPECT_NEAR(landOf(scene), expected, kRough);
}

TEST(Land, OfAChequerOfTwoTexturesIsTheirMean) {
  // 188 and 0: reflectances of 0.503 and 0; a quarter of the second texture's texels are white.
  const auto texture = [](std::uint8_t one, std::uint8_t rest) {
    scene::Texture made;
    made.width = made.height = 2;
    made.rgba.own().assign(16, rest);
    for (std::size_t i = 0; i < 4; ++i) {
      if (i < 3) made.rgba.own()[i] = one;
      made.rgba.own()[4 * i + 3] = 255;
    }
    return made;
  };
  scene::Scene scene;
  scene.textures = {texture(188, 188), texture(255, 0)};
  scene.materials = {paint(1.0f), paint(1.0f)};
  scene.materials[0].base_texture = 0;
  scene.materials[1].base_texture = 1;
  for (int x = 0; x < 8; ++x) {
    for (int y = 0; y < 8; ++y) {
      addPatch(&scene, (x + y) % 2, Eigen::Vector3f(static_cast<float>(x), static_cast<float>(y), 0.0f),
               {1, 0, 0}, {0, 1, 0});
    }
  }
  const double expected =
      0.5 * sentBack(paint(0.503f)) + 0.5 * (0.25 * sentBack(paint(1.0f)) + 0.75 * sentBack(paint(0.0f)));
  EXPECT_NEAR(landOf(scene), expected, kRough);
}

TEST(Land, OfAHallIsItsRoofAndOfOneWithoutIsItsFloor) {
  scene::Scene hall;
  hall.materials = {paint(0.2f), paint(0.6f)};
  addPatch(&hall, 0, {0, 0, 0}, {20, 0, 0}, {0, 20, 0});
  addPatch(&hall, 1, {0, 0, 6}, {0, 20, 0}, {20, 0, 0});  // which faces down
  EXPECT_NEAR(landOf(hall), sentBack(hall.materials[1]), kRough);
  hall.materials[1].double_sided = false;  // and is not seen from behind
  EXPECT_NEAR(landOf(hall), sentBack(hall.materials[0]), kRough);
}

TEST(Land, UnderABlockIsNotSeen) {
  scene::Scene scene;
  scene.materials = {paint(0.2f), paint(0.6f)};
  addPatch(&scene, 0, {0, 0, 0}, {10, 0, 0}, {0, 10, 0});
  addBlock(&scene, 1, {2, 2, 0}, {5, 4, 1});
  const double expected = 0.8 * sentBack(scene.materials[0]) + 0.2 * sentBack(scene.materials[1]);
  EXPECT_NEAR(landOf(scene), expected, kRough);
}

TEST(Land, IsTheSameNumberForAnyNumberOfThreads) {
  scene::Scene scene;
  scene.materials = {paint(0.1f), paint(0.7f)};
  addGround(&scene, 0, 50.0f);
  addBlock(&scene, 1, {2, 2, 0}, {5, 4, 1});
  const double with_all = landOf(scene);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(landOf(scene), with_all);
}

}  // namespace
}  // namespace sunlit::light
