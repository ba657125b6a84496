// Daylight in the air of rooms and of the open.
#include "light/picture/sky/open_air.h"

#include <gtest/gtest.h>

#include "paper_scene.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/transport.h"
#include "sunlit/sky/atmosphere.h"

namespace sunlit::light {
namespace {

const Eigen::Vector3f kEast = Eigen::Vector3f::UnitX();

/// A hall of 40 m × 6 m × 4 m that glows a little, without its eastern side if it is open, on level ground.
World hall(bool open) {
  scene::Scene scene;
  scene.materials = {paint(0.3f), paint(0.5f, 10.0f)};
  addGround(&scene, 0, 100.0f);
  addRoom(&scene, 1, {-20.0f, -3.0f, 0.01f}, {40.0f, 6.0f, 4.0f});
  if (open) scene.meshes.pop_back();
  // From outside it is a closed body.
  const std::size_t inner = scene.meshes.size();
  for (std::size_t m = 1; m < inner; ++m) {
    scene::Mesh outer = scene.meshes[m];
    for (auto& triangle : outer.triangles) std::swap(triangle[1], triangle[2]);
    for (Eigen::Vector3f& normal : outer.normals) normal = -normal;
    for (Eigen::Vector3f& position : outer.positions) position += 0.1f * outer.normals[0];
    scene.meshes.push_back(outer);
  }
  World world = worldOf(std::move(scene));
  TransportOptions options;
  options.finest_m = 1.0;  // the hall is plain
  world.transport = Transport::bake(world.geometry, options);
  return world;
}

const World& closedHall() {
  static const World world = hall(false);
  return world;
}

/// A hazy noon: over 30 m the air adds more to a wall than it is lit by inside.
const sky::Daylight& hazyNoon() {
  static const sky::Daylight day = [] {
    sky::AtmosphereOptions air;
    air.turbidity = 8.0;
    return sky::Atmosphere(air).daylight({Direction(Azimuth::degrees(200.0), Angle::degrees(50.0)), 1.0});
  }();
  return day;
}

struct Seen {
  double luminance;  ///< of the place as the camera sees it, cd/m²
  double open_air;   ///< OpenAir::before() it
};

/// A place on a surface, seen from `eye`.
Seen seen(const World& world, const Eigen::Vector3f& eye, const Eigen::Vector3f& place,
          const Eigen::Vector3f& normal, int material) {
  Surfaces surfaces = rowOf({{place, normal, eye - place, material}}, *world.geometry->scene);
  surfaces.eye = eye;
  Surface& surface = surfaces.tiles[0].surfaces[0];
  surface.triangle = triangleAt(*world.geometry, place, normal);
  const Outlooks outlooks = outlooksOf(surfaces, world);
  const OpenAir air(surfaces, *world.visibility, world.transport->nodeOpen().get());
  return {rowValues(surfaces, outlooks, world, illumination(world, hazyNoon()))[0],
          static_cast<double>(air.before(outlooks[0].surfaces[0].light))};
}

TEST(OpenAir, IsDarkInAClosedHall) {
  const World& world = closedHall();
  const Eigen::Vector3f wall(20.0f, 0.7f, 2.1f);
  const Seen near = seen(world, {18.0f, 0.5f, 1.5f}, wall, -kEast, 1);
  const Seen far = seen(world, {-18.0f, 0.5f, 1.5f}, wall, -kEast, 1);
  EXPECT_EQ(near.open_air, 0.0);
  EXPECT_EQ(far.open_air, 0.0);
  // 36 m of hazy air take some of the wall's light and add none: in the open they would add three times as
  // much as the wall gives.
  EXPECT_LT(far.luminance, near.luminance);
  EXPECT_GT(far.luminance, 0.8 * near.luminance);
}

TEST(OpenAir, IsLitOutsideAndBeforeTheMouthOfAHall) {
  const World world = hall(true);
  const Eigen::Vector3f outside(60.0f, 0.0f, 1.5f), inside(-18.0f, 0.0f, 1.5f);
  // Seen from outside, all of the way is as bright as in the open.
  EXPECT_EQ(seen(world, outside, {-20.0f, 0.7f, 2.1f}, kEast, 1).open_air, 1.0);
  // Deep inside, a wall beside the camera has next to nothing before it, and the ground outside nearly all.
  EXPECT_LT(seen(world, inside, {-20.0f, 0.7f, 2.1f}, kEast, 1).open_air, 0.02);
  EXPECT_GT(seen(world, inside, {60.0f, 0.7f, 0.0f}, Eigen::Vector3f::UnitZ(), 0).open_air, 0.95);
}

TEST(OpenAir, IsAsItWasWhereNothingIsBaked) {
  const World& world = closedHall();
  const Surfaces surfaces = rowOf({{{20.0f, 0.7f, 2.1f}, -kEast, -kEast, 1}}, *world.geometry->scene);
  EXPECT_EQ(OpenAir(surfaces, *world.visibility, nullptr).before(LightPlace()), 1.0f);
}

}  // namespace
}  // namespace sunlit::light
