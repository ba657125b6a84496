// What lamps and surfaces that shine give by way of other surfaces, by pencil and paper and against traced
// paths.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <numeric>

#include "light/lamps/lamp_sets.h"
#include "night_scene.h"
#include "shining_scene.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

TEST(LampBounces, FillAClosedRoomByItsAlbedo) {
  for (const float base : {0.5f, 0.8f}) {
    scene::Scene scene;
    scene.materials = {paint(base)};
    addRoom(&scene, 0, {-2.0f, -2.0f, 0.0f}, {4.0f, 4.0f, 4.0f});
    scene.lamps = {lampAt({0.0f, 0.0f, 2.0f}, 100.0f)};
    const World world = baked(std::move(scene));
    // All walls alike, and nothing lost: of the lamp's 4π I, ρ / (1 − ρ) arrives again, on 96 m².
    const double mean = 4.0 * kPi * 100.0 / 96.0 * albedoOf(base) / (1.0 - albedoOf(base));
    std::vector<Looked> floor;
    for (int i = 0; i < 8; ++i)
      for (int k = 0; k < 8; ++k)
        floor.push_back(
            {{-1.75f + 0.5f * static_cast<float>(i), -1.75f + 0.5f * static_cast<float>(k), 0.0f}, kUp, kUp});
    const std::vector<double> values = illuminances(world, floor);
    const double found = std::accumulate(values.begin(), values.end(), 0.0) / 64.0;
    // The six sides are alike, so the mean of one is that of all. 2 % as of ambientReflectance(), which
    // counts for more the more often light comes back.
    EXPECT_NEAR(found, mean, (base < 0.6f ? 0.02 : 0.04) * mean) << base;
  }
}

/// A room of 8 × 8 × 3 m with a wall across most of it, and a lamp on one side.
scene::Scene roomWithAScreen() {
  scene::Scene scene;
  scene.materials = {paint(0.6f), paint(0.3f)};
  addRoom(&scene, 0, {-4.0f, -4.0f, 0.0f}, {8.0f, 8.0f, 3.0f});
  addBlock(&scene, 1, {-0.1f, -4.0f, 0.0f}, {0.2f, 5.5f, 3.0f});
  scene.lamps = {lampAt({2.0f, -1.0f, 2.2f}, 300.0f)};
  return scene;
}

TEST(LampBounces, LightTheShadeAsTracedPathsDo) {
  const World world = baked(roomWithAScreen());
  std::vector<Looked> points;
  for (const float x : {-3.5f, -2.0f, -0.7f, 0.8f, 2.0f, 3.5f})
    for (const float y : {-3.0f, -1.0f, 0.5f, 3.0f})
      points.push_back({{x, y, 0.0f}, kUp, {0.0f, 0.6f, 0.8f}});
  for (const float y : {-3.0f, 0.0f, 3.0f})
    points.push_back({{-4.0f, y, 1.5f}, Eigen::Vector3f::UnitX(), {0.8f, 0.6f, 0.0f}});
  const std::vector<double> fast = pictured(world, points), slow = tracedWithLamps(world, points, 60000);
  // Behind the screen the lit part of the ceiling lies in few of the 175 directions of a sample: measured 23
  // % at worst. Without bounces, all of it were missing there.
  expectAlike(points, fast, slow, 0.3);
}

TEST(LampBounces, OfANightLampAreThereWhateverShinesBehindTheWall) {
  scene::Scene scene;
  scene.materials = {paint(0.5f)};
  addRoom(&scene, 0, {-2.0f, -2.0f, 0.0f}, {4.0f, 4.0f, 3.0f});
  scene.lamps = {lampAt({0.0f, 0.0f, 2.0f}, 5.0f)};
  const std::vector<Looked> places = {{{0.3f, 0.3f, 0.0f}, kUp, kUp}, {{-1.3f, 1.3f, 0.0f}, kUp, kUp}};
  const std::vector<double> alone = illuminances(baked(scene), places);
  // Each would give a floor without walls over it sixteen times as much as that one does.
  for (int i = 0; i < 10; ++i)
    scene.lamps.push_back(lampAt({6.0f, static_cast<float>(i) - 4.5f, 2.0f}, 1000.0f));
  const std::vector<double> beside = illuminances(baked(scene), places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_GT(alone[i], 0.0);
    // What is looked for is known as well as all that shines allows, hidden or not.
    EXPECT_NEAR(beside[i], alone[i], 1e-2 * alone[i]);
  }
}

TEST(LampBounces, OfASheetOfOneSideStayBeforeIt) {
  // The lamp stands east of it, where its front is.
  scene::Scene scene;
  scene.materials = {paint(0.1f), paint(0.8f)};
  scene.materials[1].double_sided = false;
  addGround(&scene, 0, 20.0f);
  addPatch(&scene, 1, {0.0f, -20.0f, 0.0f}, {0.0f, 40.0f, 0.0f}, {0.0f, 0.0f, 10.0f});
  scene.lamps = {lampAt({2.0f, 0.0f, 1.5f}, 100.0f)};
  const std::vector<double> found = illuminances(
      baked(std::move(scene)), {{{1.0f, 0.0f, 0.0f}, kUp, kUp}, {{-1.0f, 0.0f, 0.0f}, kUp, kUp}});
  EXPECT_GT(found[0], 1.0);
  EXPECT_LT(found[1], 0.01 * found[0]);  // behind it nothing is lit
}

TEST(LampBounces, GoThroughSmallLeaves) {
  // A roof of leaves over dark ground: a block in its shade is lit by what gets through them.
  scene::Scene scene;
  scene.materials = {paint(0.0f), paint(0.6f), paint(0.5f)};
  scene.materials[1].transmission = 0.4f;
  scene.materials[1].alpha_mode = scene::AlphaMode::kMask;
  scene.textures = {{"whole", 1, 1, {255, 255, 255, 255}}};
  scene.materials[1].base_texture = 0;
  addGround(&scene, 0, 100.0f);
  for (int x = -8; x < 8; ++x)
    for (int y = -8; y < 8; ++y)
      addPatch(&scene, 1, {0.5f * static_cast<float>(x), 0.5f * static_cast<float>(y), 2.0f},
               {0.5f, 0.0f, 0.0f}, {0.0f, 0.5f, 0.0f});
  addBlock(&scene, 2, {-0.5f, -0.5f, 0.0f}, {1.0f, 1.0f, 0.5f});
  scene.lamps = {lampAt({0.3f, 0.2f, 8.0f}, 3000.0f)};
  const World world = baked(std::move(scene));
  const std::vector<Looked> points = {{{0.1f, 0.2f, 0.5f}, kUp, {0.0f, 0.6f, 0.8f}, 2}};
  const std::vector<double> fast = pictured(world, points), slow = tracedWithLamps(world, points, 60000);
  // Measured −4 %: leaves share samples that lie 1.5 m apart.
  EXPECT_NEAR(fast[0] / slow[0], 1.0, 0.06);
}

TEST(LampBounces, GoWithTheLampsThatBurn) {
  scene::Scene scene = roomWithAScreen();
  scene.lamps.push_back(lampAt({-2.0f, 2.0f, 1.0f}, 50.0f, "others"));
  scene.lamps.push_back(lampAt({3.0f, 3.0f, 1.5f}, 2.0f, "others"));
  scene.lamps.back().relative = true;
  const World world = baked(std::move(scene));
  LampOptions first = kOn, others = kOn, off = kOn, dim = kOn;
  first.off = {"others"};
  others.off = {"lamps"};
  off.mode = LampMode::kOff;
  dim.colour_lx = 0.0;
  const Eigen::Vector3f place(-3.0f, -3.0f, 0.0f);
  const double all = illuminance(world, place), by_first = illuminance(world, place, kUp, first),
               by_others = illuminance(world, place, kUp, others);
  EXPECT_GT(by_first, 0.0);
  EXPECT_GT(by_others, 0.0);
  EXPECT_NEAR(all, by_first + by_others, 2.0 * 0x1p-11 * all);  // light at nodes is rounded by 2⁻¹¹
  EXPECT_EQ(illuminance(world, place, kUp, off), 0.0);
  EXPECT_LT(illuminance(world, place, kUp, dim), all);
  EXPECT_GT(illuminance(world, place, kUp, dim), by_first);
}

TEST(LampSets, AreOneForEachGroupAndUnitAndOneForTheRest) {
  std::vector<scene::Lamp> lamps;
  for (int i = 0; i < 50; ++i) lamps.push_back(lampAt({0.0f, 0.0f, 5.0f}, 10.0f, std::to_string(i)));
  lamps.push_back(lampAt({0.0f, 0.0f, 5.0f}, 10.0f, "0"));
  const std::vector<LampSet> sets = lampSets(lamps);
  ASSERT_EQ(sets.size(), kMostLampSets);
  EXPECT_EQ(sets[0].lamps, (std::vector<std::uint32_t>{0, 50}));
  EXPECT_EQ(sets.back().lamps.size(), 50u - kMostLampSets + 1);
  LampOptions options = kOn;
  options.off = {"0", "49"};
  const std::vector<float> shares = burningShares(lamps, options);
  EXPECT_EQ(shares[0], 0.0f);
  EXPECT_EQ(shares[1], 1.0f);
  EXPECT_NEAR(shares.back(), 18.0f / 19.0f, 1e-6f);
}

TEST(ShiningSurfaces, OfAHandsWidthLightTheFloorOfAHall) {
  const World world = baked(panelAboveFloor(0.1f, 8.0f));
  for (const float x : {0.0f, 3.0f, 8.0f}) {
    const double square = 64.0 + static_cast<double>(x * x);
    const double expected = 10000.0 * 0.01 * 64.0 / (square * square);
    // Interpolated between nodes where it bends, 1 / d⁴ · h² over 0.25 to 2 m.
    EXPECT_NEAR(illuminance(world, {x, 0.0f, 0.0f}), expected, 0.03 * expected) << x;
  }
}

TEST(ShiningSurfaces, OfAPanelNearByAreSummedAsThePolygonThatTheyAre) {
  // Larger than what pictures look for.
  const World world = baked(panelAboveFloor(4.0f, 2.0f));
  // A corner's view of a rectangle a × b at the distance c, four times (Howell, configuration factor B-4).
  const double a = 1.0, c = 1.0, s = std::sqrt(a * a + c * c);
  const double quarter = (2.0 * a / s * std::atan(a / s)) / (2.0 * kPi);
  EXPECT_NEAR(illuminance(world, {0.0f, 0.0f, 0.0f}), 4.0 * quarter * kPi * 10000.0,
              0.03 * 4.0 * quarter * kPi * 10000.0);
}

TEST(ShiningSurfaces, AreHiddenByWhatStandsBefore) {
  scene::Scene scene = panelAboveFloor(0.2f, 4.0f);
  addBlock(&scene, 0, {-0.5f, -0.5f, 1.9f}, {1.0f, 1.0f, 0.1f});
  const World world = baked(std::move(scene));
  // Black paint still mirrors 4 % of what it gets, of which little finds its way below the board.
  EXPECT_LT(illuminance(world, {0.0f, 0.0f, 0.0f}), 0.02 * 10000.0 * 0.04 / 16.0);
  const double square = 16.0 + 9.0, expected = 10000.0 * 0.04 * 16.0 / (square * square);
  EXPECT_NEAR(illuminance(world, {3.0f, 0.0f, 0.0f}), expected, 0.04 * expected);
}

TEST(ShiningSurfaces, OfManyPiecesGiveWhatTheyGiveTogether) {
  // 400 panels of 0.1 m over 10 m × 10 m, 5 m up, on a grid: clusters.
  scene::Scene scene = panelAboveFloor(0.1f, 5.0f);
  scene.meshes.pop_back();
  double expected = 0.0;
  for (int i = 0; i < 20; ++i) {
    for (int k = 0; k < 20; ++k) {
      const float x = 0.5f * static_cast<float>(i) - 4.75f, y = 0.5f * static_cast<float>(k) - 4.75f;
      addPatch(&scene, 1, {x - 0.05f, y - 0.05f, 5.0f}, {0.0f, 0.1f, 0.0f}, {0.1f, 0.0f, 0.0f});
      const double square = 25.0 + static_cast<double>((x - 1.0f) * (x - 1.0f) + y * y);
      expected += 10000.0 * 0.01 * 25.0 / (square * square);
    }
  }
  const World world = baked(std::move(scene));
  // Each of some 60 clusters is taken for a point amid it.
  EXPECT_NEAR(illuminance(world, {1.0f, 0.0f, 0.0f}), expected, 0.03 * expected);
}

TEST(ShiningSurfaces, OfABodyLightAllAroundAlike) {
  const double radius = 0.15, height = 4.0;
  const World world = baked(ballAboveFloor(0.15f, 4.0f));
  for (const double distance : {2.0, 6.0, 12.0}) {
    const double square = height * height + distance * distance;
    const double expected = kPi * radius * radius * 10000.0 * height / (square * std::sqrt(square));
    for (int i = 0; i < 12; ++i) {
      const double around = 0.1 + i * kPi / 6.0;
      const Eigen::Vector3d place(distance * std::cos(around), distance * std::sin(around), 0.0);
      // Between nodes 4 % too little, where light is most bent. By one of all facets for all: 0 to 3.4 times.
      EXPECT_NEAR(illuminance(world, place.cast<float>()), 0.984 * expected, 0.05 * expected)
          << distance << " " << i;
    }
  }
}

TEST(ShiningSurfaces, DoNotLightThemselves) {
  scene::Scene scene;
  scene.materials = {paint(0.0f), paint(0.5f, 1000.0f)};
  addGround(&scene, 0, 20.0f);
  // Double-sided, and aslant, where rounding puts points of a plane on either side of it.
  addPatch(&scene, 1, {5.1f, 3.3f, 2.0f}, {1.6f, 0.3f, 1.2f}, {-0.3f, 2.0f, 0.1f});
  const World world = baked(std::move(scene));
  const Eigen::Vector3f middle = Eigen::Vector3f(5.1f, 3.3f, 2.0f) + 0.5f * Eigen::Vector3f(1.3f, 2.3f, 1.3f);
  const Eigen::Vector3f normal =
      Eigen::Vector3f(1.6f, 0.3f, 1.2f).cross(Eigen::Vector3f(-0.3f, 2.0f, 0.1f)).normalized();
  // Black ground mirrors 4 % of what the panel gives it.
  EXPECT_LT(illuminance(world, middle + 0.2f * Eigen::Vector3f(1.6f, 0.3f, 1.2f), normal),
            0.01 * kPi * 1000.0);
}

TEST(ShiningSurfaces, AslantLightTheGroundBeforeThemAlone) {
  // 3.6 m wide, 6 m up, 45 degrees aslant: the ground is lit from x = -6 m on, most below the panel.
  const float half = 1.8f, aslant = half / std::sqrt(2.0f);
  const Eigen::Vector3f corner(-aslant, -half, 6.0f - aslant), u(0.0f, 2.0f * half, 0.0f),
      v(2.0f * aslant, 0.0f, 2.0f * aslant);
  scene::Scene scene;
  scene.materials = {paint(0.0f), paint(0.0f, 50.0f)};
  scene.materials[1].double_sided = false;
  addGround(&scene, 0, 90.0f);
  addPatch(&scene, 1, corner, u, v);
  const World world = baked(std::move(scene));
  const auto exact = [&](const Eigen::Vector3f& place) {
    return 50.0 * byPatch(corner.cast<double>(), u.cast<double>(), v.cast<double>(), place.cast<double>());
  };
  for (int i = 0; i < 80; ++i) {
    const Eigen::Vector3f place(0.39f * static_cast<float>(i % 20) - 5.1f, 1.23f * static_cast<float>(i / 20),
                                0.0f);
    // Between nodes, where it bends. With cells up to 0.7 of the distance: 12 % too little.
    EXPECT_NEAR(illuminance(world, place) / exact(place), 1.0, 0.04) << place.transpose();
  }
  // What is fainter than 0.05 lx, 0.4 % of the most, may be interpolated across the panel's plane.
  for (const float x : {-7.8f, -10.5f, -15.0f}) {
    for (const float y : {0.0f, 9.0f, 12.0f, 16.5f})
      EXPECT_LT(illuminance(world, {x, y, 0.0f}), 1e-3 * exact(Eigen::Vector3f::Zero())) << x << " " << y;
  }
}

TEST(ShiningSurfaces, WithHolesGiveAsMuchAsIsThere) {
  // Stripes, of which every second is cut out, or blends by half.
  const auto lit = [](scene::AlphaMode mode, std::uint8_t clear, std::uint8_t solid) {
    scene::Scene scene = panelAboveFloor(1.0f, 6.0f);
    scene::Texture stripes;
    stripes.name = "stripes";
    stripes.width = 32;
    stripes.height = 32;
    for (int i = 0; i < 32 * 32; ++i)
      stripes.rgba.own().insert(stripes.rgba.own().end(), {255, 255, 255, i / 4 % 2 == 0 ? clear : solid});
    scene.textures.push_back(stripes);
    scene.materials[1].base_texture = 0;
    scene.materials[1].alpha_mode = mode;
    return illuminance(baked(std::move(scene)), {0.0f, 0.0f, 0.0f});
  };
  const double whole = lit(scene::AlphaMode::kOpaque, 0, 255);
  EXPECT_GT(whole, 0.0);
  // Cut off between texels of 0 and 255, so half is there; sixteen points of each of 128 parts tell how much.
  EXPECT_NEAR(lit(scene::AlphaMode::kMask, 0, 255) / whole, 0.5, 0.04);
  EXPECT_NEAR(lit(scene::AlphaMode::kBlend, 128, 128) / whole, 0.5, 0.04);
}

TEST(ShiningSurfaces, LookAsByTracedPaths) {
  scene::Scene scene = roomWithAScreen();
  scene.lamps.clear();
  scene.materials.push_back(paint(0.0f, 2000.0f));
  scene.materials[2].double_sided = false;
  addPatch(&scene, 2, {1.0f, -2.5f, 2.99f}, {0.0f, 1.2f, 0.0f}, {1.2f, 0.0f, 0.0f});
  const World world = baked(std::move(scene));
  std::vector<Looked> points;
  for (const auto& [x, y] : {std::pair(-2.0f, 3.0f), std::pair(-1.0f, 3.0f), std::pair(1.0f, 0.0f),
                             std::pair(1.0f, 3.0f), std::pair(3.0f, 0.0f), std::pair(3.0f, 3.0f)})
    points.push_back({{x, y, 0.0f}, kUp, {0.0f, 0.6f, 0.8f}});
  const std::vector<double> fast = pictured(world, points), slow = tracedWithLamps(world, points, 20000);
  expectAlike(points, fast, slow, 0.15);
}

TEST(LampBounces, HaveTheSameBitsOnAnyNumberOfThreads) {
  std::vector<std::vector<double>> results;
  for (const std::size_t threads : {1, 3}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    scene::Scene scene = roomWithAScreen();
    scene.materials.push_back(paint(0.0f, 500.0f));
    addBlock(&scene, 2, {-3.0f, -2.5f, 2.9f}, {1.2f, 1.2f, 0.1f});
    const World world = baked(std::move(scene));
    std::vector<Looked> points;
    for (const float x : {-3.0f, -1.0f, 1.0f, 3.0f}) points.push_back({{x, 0.3f, 0.0f}, kUp, kUp});
    results.push_back(illuminances(world, points));
  }
  EXPECT_EQ(results[0], results[1]);
}

}  // namespace
}  // namespace sunlit::light
