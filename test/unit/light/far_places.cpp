// Bakes of what lies or reaches tens of kilometres from the origin, where single precision knows a place by
// centimetres.
#include <gtest/gtest.h>

#include <algorithm>

#include "baked_scene.h"
#include "light/bake/gather/relight.h"
#include "light/bake/samples/crown_shadows.h"
#include "light/bake/samples/transport_data.h"

namespace sunlit::light {
namespace {

/// Mean over a wall of 21 m × 10 m that stands askew, and the ground about it, under an even sky of 1 cd/m²,
/// lx.
double onAWallAt(float x_m) {
  scene::Scene scene;
  scene.materials = {paint(0.0f)};
  addPatch(&scene, 0, {x_m, x_m + 0.2f, 5.1f}, {15.1f, 14.3f, 0.0f}, {0.0f, 0.0f, 10.0f});
  addPatch(&scene, 0, {x_m - 10.0f, x_m - 10.0f, 5.0f}, {40.0f, 0.0f, 0.0f}, {0.0f, 40.0f, 0.0f});
  const World world = baked(std::move(scene));
  const std::vector<NodeLight> nodes = world.transport->relight(uniformDay(1.0f));
  double sum = 0.0;
  for (const NodeLight& node : nodes)
    sum += static_cast<double>(node.irradiance[1]) / static_cast<double>(nodes.size());
  return sum;
}

TEST(FarPlaces, AreAsBrightAsThoseNearTheOrigin) {
  const double here = onAWallAt(0.1f);
  // Corners are known by 8 mm there, which turns such a wall by next to nothing. Rays that
  // started 5 mm off it would meet it, and leave 7 % in the dark.
  EXPECT_NEAR(onAWallAt(90000.1f), here, 0.02 * here);
}

TEST(FarPlaces, OfLeavesAreNotShadedByTheirOwnLeaf) {
  scene::Scene scene = leafSceneOf({"whole", 1, 1, {255, 255, 255, 255}});
  const Eigen::Vector3f corner(90000.1f, 0.3f, 5.1f), one(3.0f, 0.0f, 1.7f), two(0.4f, 2.0f, 0.9f);
  addPatch(&scene, 0, corner, one, two);
  const auto shared = std::make_shared<const Geometry>(std::make_shared<const scene::Scene>(scene));
  const Cutouts cutouts(*shared);
  const Visibility visibility(shared);
  std::vector<CrownShadows::Point> points;
  for (int i = 0; i < 100; ++i) {
    const auto u = static_cast<float>(i % 10 + 1) / 11.0f, v = static_cast<float>(i / 10 + 1) / 11.0f;
    points.push_back({corner + u * one + v * two, one.cross(two).normalized()});
  }
  CrownShadows crown({*shared, cutouts, visibility}, points, 16.0f);
  const std::vector<std::uint8_t>& open = crown.open(Eigen::Vector3f(0.3f, 0.2f, 0.9f).normalized());
  EXPECT_EQ(std::count(open.begin(), open.end(), 1), 100);
}

TEST(FarPlaces, OfHugeRoomsAreLookedAtBySunAndMoonAsFinelyAsOthers) {
  scene::Scene scene;
  scene.materials = {paint(0.5f)};
  addRoom(&scene, 0, Eigen::Vector3f::Constant(-95000.0f), Eigen::Vector3f::Constant(190000.0f));
  TransportOptions options;
  options.samples = 1000;
  const World world = baked(std::move(scene), options);
  std::uint32_t most = 0;
  for (const BakedRooms::Source& source : world.transport->data().rooms.sources)
    most = std::max(most, source.points);
  EXPECT_EQ(most, 144u);  // parts of 200 km² each, of which none has fewer points than one of 0.3 m²
}

}  // namespace
}  // namespace sunlit::light
