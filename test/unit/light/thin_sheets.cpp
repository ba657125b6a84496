// Light that passes cloth and paper, beside the path tracer.
#include <gtest/gtest.h>

#include <map>

#include "baked_scene.h"

namespace sunlit::light {
namespace {

constexpr int kGround = 0, kCloth = 1;

/// An awning of 6 × 6 m, 2.5 m above the ground, of so many pieces a side.
scene::Scene awning(int pieces) {
  scene::Scene scene;
  scene.materials = {paint(0.3f), paint(0.8f)};
  scene.materials[kCloth].transmission = 0.4f;
  scene.materials[kCloth].double_sided = true;
  addGround(&scene, kGround, 100.0f);
  const float side = 6.0f / static_cast<float>(pieces);
  for (int x = 0; x < pieces; ++x)
    for (int y = 0; y < pieces; ++y)
      addPatch(&scene, kCloth,
               {-3.0f + side * static_cast<float>(x), -3.0f + side * static_cast<float>(y), 2.5f},
               {side, 0.0f, 0.0f}, {0.0f, side, 0.0f});
  return scene;
}

const Eigen::Vector3f kUp = Eigen::Vector3f::UnitZ();

class Awning : public ::testing::TestWithParam<int> {
 protected:
  /// Of that many pieces, baked once.
  static const World& world() {
    static std::map<int, World> known;
    const auto at = known.find(GetParam());
    return at != known.end() ? at->second
                             : known.emplace(GetParam(), baked(awning(GetParam()))).first->second;
  }
};

/// Of one piece whose sides have cells of their own, and of pieces so small that they share samples.
INSTANTIATE_TEST_SUITE_P(Pieces, Awning, ::testing::Values(1, 12));

TEST_P(Awning, LetsItsShareOfTheSkyThroughToTheGround) {
  std::vector<Looked> ground;
  for (const float x : {0.1f, 0.9f, 1.9f})
    ground.push_back({{x, 0.3f, 0.0f}, kUp, {0.3f, 0.1f, 1.0f}, kGround});
  const Errors found =
      errors(fast(world(), ground, uniformDay(100.0f)), traced(world(), ground, uniformDay(100.0f), 30000));
  EXPECT_LT(found.mean, 0.05) << found.bias;
}

TEST_P(Awning, ShowsEitherSideTheLightOfBoth) {
  std::vector<Looked> cloth;
  for (const float x : {0.1f, 1.1f, 2.1f}) {
    cloth.push_back({{x, 0.3f, 2.5f}, kUp, {0.3f, 0.1f, 1.0f}, kCloth});
    cloth.push_back({{x, 0.3f, 2.5f}, -kUp, {0.3f, 0.1f, -1.0f}, kCloth});
  }
  const Errors found =
      errors(fast(world(), cloth, uniformDay(100.0f)), traced(world(), cloth, uniformDay(100.0f), 30000));
  EXPECT_LT(found.mean, 0.05) << found.bias;
  EXPECT_LT(found.worst, 0.08);
}

TEST_P(Awning, LetsAsMuchThroughThatIsSeenFromAboveAlone) {
  scene::Scene one_sided = awning(GetParam());
  one_sided.materials[kCloth].double_sided = false;
  const std::vector<Looked> ground = {{{0.9f, 0.3f, 0.0f}, kUp, {0.3f, 0.1f, 1.0f}, kGround}};
  EXPECT_EQ(fast(baked(one_sided), ground, uniformDay(100.0f)), fast(world(), ground, uniformDay(100.0f)));
}

TEST(Cloth, ThatIsLevelMirrorsTheSkyOntoAWallOnce) {
  scene::Scene scene;
  scene.materials = {paint(0.0f), paint(0.8f), paint(0.5f)};
  scene.materials[kCloth].transmission = 0.4f;
  scene.materials[kCloth].double_sided = true;
  scene.materials[kCloth].roughness = 0.6f;
  addGround(&scene, kGround, 100.0f);
  addPatch(&scene, kCloth, {-4.0f, -8.0f, 0.8f}, {8.0f, 0.0f, 0.0f}, {0.0f, 8.0f, 0.0f});
  addPatch(&scene, 2, {-4.0f, 0.0f, 0.0f}, {8.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 4.0f});  // it faces −y
  const World world = baked(scene);
  std::vector<Looked> wall;
  for (const float z : {1.1f, 1.6f, 2.3f})
    wall.push_back({{0.3f, 0.0f, z}, -Eigen::Vector3f::UnitY(), {0.3f, -1.0f, 0.2f}, 2});
  const Errors found =
      errors(fast(world, wall, uniformDay(100.0f)), traced(world, wall, uniformDay(100.0f), 30000));
  EXPECT_LT(found.mean, 0.04) << found.bias;
}

}  // namespace
}  // namespace sunlit::light
