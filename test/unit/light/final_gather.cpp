// What surfaces see of the sky by rays of their own, where it can be worked out on paper, and against traced
// light.
#include "light/picture/gather/final_gather.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "leaf_scenes.h"
#include "light/patches/sky_patches.h"
#include "light/picture/gather/gathered_light.h"
#include "light/picture/gather/kept_nodes.h"
#include "paper_scene.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/picture.h"
#include "sunlit/light/transport.h"
#include "sunlit/quantity/angle.h"
#include "support/message_of.h"

namespace sunlit::light {
namespace {

const Eigen::Vector3f kUp = Eigen::Vector3f::UnitZ();

/// As after a bake, as far as final gathering asks for it.
struct Located {
  Surfaces surfaces;
  Outlooks outlooks;

  Located(const std::vector<Looked>& points, const World& world) : surfaces(onTriangles(points, world)) {
    forget(surfaces, &outlooks);
    for (std::size_t t = 0; t < outlooks.size(); ++t) {
      for (std::size_t i = 0; i < outlooks[t].surfaces.size(); ++i) {
        outlooks[t].surfaces[i].light.node = {0, 0, 0};
        if (surfaces.tiles[t].surfaces[i].material != kLeaf) continue;
        outlooks[t].surfaces[i].sheet = static_cast<std::uint32_t>(outlooks[t].sheets.size());
        outlooks[t].sheets.emplace_back().sky.known = true;
      }
    }
  }
  void look(FinalGather* gather) { gather->look(surfaces, &outlooks); }
  void look(const World& world, int rays) {
    FinalGather gather(world.geometry, world.visibility, rays);
    look(&gather);
  }
};

const GatheredSky& skyOf(const Outlooks& outlooks, std::size_t point) {
  const TileOutlooks& tile = outlooks[point / Surfaces::kTileSize];
  return tile.gathered.at(tile.surfaces[point % Surfaces::kTileSize].gathered);
}

PatchSky evenSky() {
  return PatchSky(SkyPatches::luminances(uniformDay(1.0f), SkyPatches::Weight::kEven));
}

/// Shares of the half spheres before and behind each point, by cosine, that are open sky.
struct Shares {
  float front, behind;
};
std::vector<Shares> openAround(const std::vector<Looked>& points, const World& world, int rays) {
  Located located(points, world);
  located.look(world, rays);
  std::vector<Shares> shares;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const GatheredLight light = gatheredLight(skyOf(located.outlooks, i), evenSky(), points[i].normal);
    // Light of 1 cd/m² from all of the half sphere is π lx.
    EXPECT_NEAR(light.front[1], kPiFloat * light.front[3], 1e-3f);
    shares.push_back({light.front[3], light.behind[3]});
  }
  return shares;
}

TEST(FinalGather, APlateInTheOpenSeesTheSkyAndNothingBelow) {
  scene::Scene scene = leafScene();
  addPatch(&scene, kBoard, {-0.5f, -0.5f, 1.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
  const World world = worldOf(std::move(scene));
  const Shares level = openAround({{{0.1f, -0.2f, 1.0f}, kUp, kUp, kBoard}}, world, 1)[0];
  EXPECT_NEAR(level.front, 1.0f, 1e-4f);  // what is stored is exactly 1 here
  EXPECT_EQ(level.behind, 0.0f);
  const Shares under = openAround({{{0.1f, -0.2f, 1.0f}, -kUp, -kUp, kBoard}}, world, 1)[0];
  EXPECT_EQ(under.front, 0.0f);
}

TEST(FinalGather, AThinSheetThatStandsSeesHalfTheSkyOnEitherSide) {
  scene::Scene scene = leafScene();
  addPatch(&scene, kLeaf, {1.0f, -0.5f, 1.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f});
  const World world = worldOf(std::move(scene));
  const Eigen::Vector3f normal = Eigen::Vector3f::UnitX();
  const Shares shares = openAround({{{1.0f, 0.2f, 1.3f}, normal, normal, kLeaf}}, world, 1)[0];
  EXPECT_NEAR(shares.front, 0.5f, 1e-4f);
  EXPECT_NEAR(shares.behind, 0.5f, 1e-4f);
}

TEST(FinalGather, AnOpaqueWallIsNotDarkenedByItsOwnPlane) {
  // Its plane cuts patches, of which the part before it is open, whether it has a ray or not.
  for (const float turn : {0.0f, 0.3f, 0.6435f, 1.2f}) {
    scene::Scene scene = leafScene();
    const Eigen::Vector3f along(std::cos(turn), std::sin(turn), 0.0f), normal(along.y(), -along.x(), 0.0f);
    addPatch(&scene, kBoard, {1.0f, 0.0f, 1.0f}, along, Eigen::Vector3f::UnitZ());
    const World world = worldOf(std::move(scene));
    std::vector<Looked> points;
    for (const float share : {0.21f, 0.5f, 0.93f}) {
      const Eigen::Vector3f point = Eigen::Vector3f(1.0f, 0.0f, 1.37f) + share * along;
      points.push_back({point, normal, normal, kBoard});
    }
    for (const Shares& shares : openAround(points, world, 1)) EXPECT_NEAR(shares.front, 0.5f, 1e-4f) << turn;
  }
}

TEST(FinalGather, SeesAWallsShadeWithinCentimetres) {
  // Behind a wall without end at distance d, of height h, (1 + d / √(d² + h²)) / 2 of the sky is left.
  constexpr float kHeight = 0.1f;
  scene::Scene scene = leafScene();
  addPatch(&scene, kBoard, {0.0f, -0.5f, 1.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
  addPatch(&scene, kBoard, {0.0f, -300.0f, 1.0f}, {0.0f, 600.0f, 0.0f}, {0.0f, 0.0f, kHeight});
  const World world = worldOf(std::move(scene));
  std::vector<Looked> points;
  for (const float distance : {0.02f, 0.06f, 0.11f, 0.23f, 0.4f, 0.8f})
    points.push_back({{distance, 0.113f, 1.0f}, kUp, kUp, kBoard});
  const std::vector<Shares> shares = openAround(points, world, 4);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float distance = points[i].position.x();
    const float open = 0.5f * (1.0f + distance / std::hypot(distance, kHeight));
    // Interpolating over 3.5 cm, where the share bends by h / d² at most, and 700 rays of which those that
    // graze the wall's edge decide.
    EXPECT_NEAR(shares[i].front, open, 0.03f) << distance;
  }
}

TEST(FinalGather, SeesTheEdgeOfAShadeOnALongThinPost) {
  // Before it hangs a board without end at distance d: h below its edge (sin atan(h / d)) / 2 of the sky is
  // left, above it nothing.
  constexpr float kDistance = 0.1f, kEdge = 1.0f;
  scene::Scene scene = leafScene();
  addPatch(&scene, kBoard, {0.0f, -0.025f, 0.0f}, {0.0f, 0.05f, 0.0f}, {0.0f, 0.0f, 2.0f});
  addPatch(&scene, kBoard, {kDistance, -300.0f, kEdge}, {0.0f, 600.0f, 0.0f}, {0.0f, 0.0f, 300.0f});
  const World world = worldOf(std::move(scene));
  const Eigen::Vector3f normal = Eigen::Vector3f::UnitX();
  std::vector<Looked> points;
  for (const float below : {-0.1f, 0.03f, 0.1f, 0.3f})
    points.push_back({{0.0f, 0.004f, kEdge - below}, normal, normal, kBoard});
  const std::vector<Shares> shares = openAround(points, world, 4);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float below = std::max(kEdge - points[i].position.z(), 0.0f);
    // 0.054 measured: nodes are 14 cm apart along the post.
    EXPECT_NEAR(shares[i].front, 0.5f * std::sin(std::atan(below / kDistance)), 0.07f) << below;
  }
}

TEST(FinalGather, APlateOverNothingIsLitFromBelowAsTracedPathsSay) {
  // By the ground of the sky itself.
  scene::Scene scene = leafScene();
  scene.materials[kBoard] = paint(0.5f);
  addPatch(&scene, kBoard, {0.0f, -0.5f, 1.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f});
  World world = worldOf(std::move(scene));
  world.transport = Transport::bake(world.geometry, {});
  const sky::Daylight day = uniformDay(1000.0f, 0.5);
  const Eigen::Vector3f normal = Eigen::Vector3f::UnitX();
  const std::vector<Looked> points = {{{0.0f, -0.2f, 1.3f}, normal, normal, kBoard}};
  FinalGather gather(world.geometry, world.visibility, 1);
  const Surfaces surfaces = onTriangles(points, world);
  const Outlooks outlooks = outlooksOf(surfaces, world, &gather);
  ASSERT_EQ(outlooks[0].gathered.size(), 1u);
  const std::vector<double> fast = rowValues(surfaces, outlooks, world, illumination(world, day));
  const std::vector<double> slow = traced(world, points, day, 4096);
  EXPECT_GT(slow[0], 100.0);
  EXPECT_NEAR(fast[0], slow[0], 0.03 * slow[0]);  // 160 directions below the horizon, and 1 % noise
}

TEST(FinalGather, LeavesLargeTrianglesAndWhatIsNotBakedAlone) {
  scene::Scene scene = leafScene();
  addPatch(&scene, kBoard, {-4.0f, -4.0f, 0.0f}, {8.0f, 0.0f, 0.0f}, {0.0f, 8.0f, 0.0f});
  addPatch(&scene, kBoard, {-0.5f, -0.5f, 1.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
  addPatch(&scene, kLeaf, {-4.0f, -4.0f, 2.0f}, {8.0f, 0.0f, 0.0f}, {0.0f, 8.0f, 0.0f});
  const World world = worldOf(std::move(scene));
  Located located({{{1.0f, 0.2f, 0.0f}, kUp, kUp, kBoard},
                   {{0.1f, 0.2f, 1.0f}, kUp, kUp, kBoard},
                   {{0.1f, 0.2f, 1.0f}, kUp, kUp, kBoard},
                   {{0.1f, 0.2f, 1.0f}, kUp, kUp, kBoard},
                   {{1.0f, 0.2f, 2.0f}, kUp, kUp, kLeaf}},
                  world);
  const TileOutlooks& tile = located.outlooks[0];
  located.outlooks[0].surfaces[1].light = LightPlace();  // of a place that the bake left out
  located.surfaces.tiles[0].surfaces[2].triangle =
      static_cast<std::uint32_t>(world.geometry->triangles.size());  // of a body
  FinalGather gather(world.geometry, world.visibility, 1);
  located.look(&gather);
  ASSERT_EQ(tile.gathered.size(), 2u);
  for (const std::size_t alone : {0u, 1u, 2u})
    EXPECT_EQ(tile.surfaces[alone].gathered, Outlook::kNotGathered) << alone;
  EXPECT_EQ(tile.surfaces[3].gathered, 0u);
  EXPECT_EQ(tile.surfaces[4].gathered, 1u);
  EXPECT_EQ(gather.nodesSeen(), 6u);
  EXPECT_EQ(gather.nodesCast(), 6u);
}

TEST(FinalGather, IsTheSameForAnyNumberOfThreadsAndWhateverWasSeenBefore) {
  std::vector<Looked> points;
  const World world = worldOf(crown(&points));
  const std::vector<Looked> half(points.begin(), points.begin() + 60);
  const auto bytes = [](const Located& located) {
    std::vector<std::uint8_t> all;
    for (const TileOutlooks& tile : located.outlooks)
      for (const GatheredSky& sky : tile.gathered) all.insert(all.end(), sky.open.begin(), sky.open.end());
    return all;
  };
  FinalGather gather(world.geometry, world.visibility, 2);
  Located first(points, world);
  first.look(&gather);
  const std::size_t seen = gather.nodesSeen();
  EXPECT_EQ(gather.nodesCast(), seen);
  Located other(half, world);
  other.look(&gather);
  EXPECT_EQ(gather.nodesCast(), 0u);  // all of them are known
  Located again(points, world);
  again.look(&gather);
  EXPECT_EQ(gather.nodesSeen(), seen);
  EXPECT_EQ(bytes(again), bytes(first));

  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  Located alone(half, world);
  alone.look(world, 2);
  EXPECT_EQ(bytes(alone), bytes(other));
  EXPECT_FALSE(bytes(alone).empty());
}

TEST(FinalGather, LightsACrownAsTracedPathsDo) {
  std::vector<Looked> points;
  World world = worldOf(crown(&points));
  world.transport = Transport::bake(world.geometry, {});
  FinalGather gather(world.geometry, world.visibility, 2);
  const sky::Daylight even = uniformDay(1000.0f);
  const std::vector<double> slow = traced(world, points, even, 512);
  const auto error = [&](FinalGather* closely) {
    const Surfaces surfaces = onTriangles(points, world);
    return differenceOf(
        rowValues(surfaces, outlooksOf(surfaces, world, closely), world, illumination(world, even)), slow);
  };
  // 0.047 and 0.125 measured, of which 1 % is noise of the traced light. What is left closely is light that
  // leaves pass on; of baked light edges of shade within a step of the grids as well. By the nodes alone,
  // without grids, 0.20.
  const double closely = error(&gather), baked = error(nullptr);
  EXPECT_LT(closely, 0.06);
  EXPECT_LT(baked, 0.13);
  EXPECT_LT(closely, 0.5 * baked);
}

TEST(FinalGather, LeavesSeeTheirShareOfTheSunWithinPenumbrae) {
  // Across the penumbra of a straight edge 3 m above a leaf: the sun in the zenith is 28 mm wide from there.
  constexpr float kHeight_m = 3.0f;
  constexpr int kPoints = 33;
  scene::Scene scene = leafScene();
  addPatch(&scene, kLeaf, {-0.5f, -0.5f, 1.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
  addPatch(&scene, kBoard, {-4.0f, -4.0f, 1.0f + kHeight_m}, {4.0f, 0.0f, 0.0f}, {0.0f, 8.0f, 0.0f});
  const World world = worldOf(std::move(scene));
  const sky::Daylight day = onlySun(0.0, 90.0);
  const float radius_m = kHeight_m * std::tan(static_cast<float>(day.sun().angular_radius.rad()));
  std::vector<Looked> points;
  for (int i = 0; i < kPoints; ++i) {
    const float x = radius_m * (static_cast<float>(i) / 12.0f - 1.3f);
    points.push_back({{x, 0.01f, 1.0f}, kUp, kUp, kLeaf});
  }
  const auto error = [&](bool closely) {
    Located located(points, world);
    if (closely) located.look(world, 1);
    const std::vector<double> light = rowValues(located.surfaces, located.outlooks, world, day);
    double sum = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      // Of a disc cut by a chord at x radii from its middle: 1/2 + (asin x + x √(1 − x²)) / π.
      const double x = std::clamp(static_cast<double>(points[i].position.x() / radius_m), -1.0, 1.0);
      const double share = 0.5 + (std::asin(x) + x * std::sqrt(1.0 - x * x)) / kPi;
      sum += std::abs(light[i] / light.back() - share);
    }
    return sum / kPoints;
  };
  // 0.043 and 0.079 measured: of sixteen points of the disc or of four, those near the chord are in doubt.
  const double closely = error(true), sparingly = error(false);
  EXPECT_LT(closely, 0.05);
  EXPECT_LT(closely, 0.7 * sparingly);
}

TEST(PicturePreparer, RefusesANumberOfRaysOutOfRange) {
  const World world = worldOf(levelLeaf());
  for (const int rays : {-1, 17}) {
    EXPECT_EQ(messageOf([&] { PicturePreparer(world, rays); }),
              "final_gather is " + std::to_string(rays) + ", but must be from 0 to 16");
  }
}

TEST(KeptNodes, KeepsWhatAPoseSawWhileItIsAskedForInParts) {
  KeptNodes kept;
  std::vector<KeptNodes::Key> whole;
  for (KeptNodes::Key key = 0; key < 640; ++key) whole.push_back(key);
  EXPECT_EQ(kept.require(whole).size(), whole.size());
  for (int pass = 0; pass < 5; ++pass) {
    for (KeptNodes::Key band = 0; band < 64; ++band) {
      const std::vector<KeptNodes::Key> part(whole.begin() + static_cast<std::ptrdiff_t>(10 * band),
                                             whole.begin() + static_cast<std::ptrdiff_t>(10 * band + 10));
      EXPECT_TRUE(kept.require(part).empty()) << pass << " " << band;
    }
  }
}

TEST(KeptNodes, ForgetsWhatNoRecentPoseHasAskedFor) {
  KeptNodes kept;
  EXPECT_EQ(kept.require({1, 2, 3}), (std::vector<KeptNodes::Key>{1, 2, 3}));
  kept.at(2).open[5] = 77;
  EXPECT_EQ(kept.require({2, 3, 4}), (std::vector<KeptNodes::Key>{4}));
  EXPECT_EQ(kept.at(2).open[5], 77);
  std::size_t most = 0;
  for (KeptNodes::Key key = 10; key < 100; key += 3) {
    EXPECT_EQ(kept.require({2, key, key + 1, key + 2}).size(), 3u) << key;
    EXPECT_EQ(kept.at(2).open[5], 77) << key;
    most = std::max(most, kept.size());
  }
  EXPECT_LE(most, 2u * 3 * 4);
  EXPECT_EQ(kept.require({1}), (std::vector<KeptNodes::Key>{1}));  // long ago
  EXPECT_EQ(kept.at(1).open[5], 0);
}

}  // namespace
}  // namespace sunlit::light
