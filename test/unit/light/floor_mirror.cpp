// Ways of light from a disc by way of polished floors.
#include "light/picture/disc/floor_mirror.h"

#include <gtest/gtest.h>

#include <cmath>

#include "light/geometry/ray_list.h"
#include "paper_scene.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

constexpr double kElevation = 30.0 * kRadPerDeg;
constexpr float kTanRadius = 0.0047f;

/// A floor of `roughness`, and a slab 10 m to the east that begins `high` m above it.
World floorBelowASlab(float roughness, float high) {
  scene::Scene scene;
  scene.materials = {paint(0.2f), paint(0.5f)};
  scene.materials[0].roughness = roughness;
  addGround(&scene, 0, 50.0f);
  addBlock(&scene, 1, {10.0f, -20.0f, high}, {0.1f, 40.0f, 20.0f});
  return worldOf(std::move(scene));
}

/// Whether a ray from 1 m above the floor is stopped that goes down to the east, `more_deg` steeper than to
/// the picture of a disc in the east, 30° high.
bool isStopped(const World& world, double more_deg) {
  const Eigen::Vector3d disc(std::cos(kElevation), 0.0, std::sin(kElevation));
  const double down = kElevation + more_deg * kRadPerDeg;
  const FloorMirror mirror(*world.visibility, disc.cast<float>(), kTanRadius);
  RayList ray;
  ray.reserve(1);
  ray.add(0, {-1.0f, 0.0f, 1.0f}, Eigen::Vector3d(std::cos(down), 0.0, -std::sin(down)).cast<float>());
  std::uint8_t stopped = 7;
  mirror.stopped(ray.rays(), &stopped);
  EXPECT_LE(stopped, 1);
  return stopped == 1;
}

TEST(FloorMirror, IsTheWayToTheDiscItselfWhereverAFacetLeans) {
  // 10 m further the disc stands 5.4 to 5.5 m above the floor; a ray that went on as it was turned, 3°
  // steeper, would be 6.1 m high there.
  const World above = floorBelowASlab(0.1f, 5.8f), before = floorBelowASlab(0.1f, 4.0f);
  for (const double more_deg : {0.0, 3.0}) {
    EXPECT_FALSE(isStopped(above, more_deg)) << more_deg;
    EXPECT_TRUE(isStopped(before, more_deg)) << more_deg;
  }
}

TEST(FloorMirror, IsNoRoughFloor) {
  EXPECT_TRUE(isStopped(floorBelowASlab(0.3f, 5.8f), 0.0));
}

TEST(FloorMirror, TellsTheFloorThatARayMeets) {
  const World world = floorBelowASlab(0.1f, 5.8f);
  const FloorMirror mirror(*world.visibility, Eigen::Vector3f::UnitX(), kTanRadius);
  const auto floor = mirror.floorAlong({0.0f, 0.0f, 2.0f}, -Eigen::Vector3f::UnitZ());
  ASSERT_TRUE(floor);
  EXPECT_FLOAT_EQ(floor->reflection.roughness, 0.1f);
  EXPECT_FALSE(mirror.floorAlong({0.0f, 0.0f, 2.0f}, Eigen::Vector3f::UnitZ()));
}

}  // namespace
}  // namespace sunlit::light
