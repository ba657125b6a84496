// How much of the sky leaves see, where it can be worked out on paper, and against traced light.
#include "light/bake/samples/leaf_openness.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "leaf_scenes.h"
#include "light/bake/samples/bake_rays.h"
#include "light/bake/samples/light_place.h"
#include "light/bake/samples/transport_data.h"
#include "light/geometry/corners.h"
#include "light/patches/sky_sectors.h"
#include "paper_scene.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/transport.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

LeafOpenness opennessOf(scene::Scene scene, std::shared_ptr<const Geometry>* geometry) {
  *geometry = std::make_shared<const Geometry>(std::make_shared<const scene::Scene>(std::move(scene)));
  const std::vector<TriangleTraits> traits = triangleTraits(**geometry, BakeRays(*geometry));
  return leafOpenness(*geometry, traits, [](double) {});
}

struct OnLeaf {
  std::uint32_t triangle;
  std::array<float, 3> within;
};
/// `point` on the first leaf's two triangles.
OnLeaf onLeaf(const Geometry& geometry, const Eigen::Vector3f& point) {
  for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
    if (geometry.materials[t] != kLeaf) continue;
    const auto& corners = geometry.triangles[t];
    Eigen::Matrix3f of_corners;
    for (int k = 0; k < 3; ++k) of_corners.col(k) = geometry.positions[corners[static_cast<std::size_t>(k)]];
    const Eigen::Vector3f within =
        of_corners.inverse() * point;  // as no leaf's plane goes through the origin
    if (within.minCoeff() >= -1e-4f) return {t, {within[0], within[1], within[2]}};
  }
  throw std::logic_error("no leaf there");
}

SkyOpenness viewAt(const Geometry& geometry, const LeafOpenness& leaves, const Eigen::Vector3f& point) {
  const OnLeaf place = onLeaf(geometry, point);
  return leaves.at(place.triangle, place.within);
}

/// Share of the half sphere about `normal`, by cosine, that is open sky.
float openAround(const SkyOpenness& view, const Eigen::Vector3f& normal) {
  return SkySectors(uniformDay(1.0f)).irradiance(view, normal).front[3];
}

// Of a share: normals to within 2°, of which half counts towards a half sphere cut by the horizon, the sum
// over directions, 0.3 %, and the step of stored shares.
constexpr float kExact = 0.025f;

TEST(LeafOpenness, OpenLeavesSeeTheSkyAboveThemAndNoneBelow) {
  scene::Scene scene = levelLeaf();
  std::shared_ptr<const Geometry> geometry;
  const LeafOpenness leaves = opennessOf(scene, &geometry);
  const SkyOpenness view = viewAt(*geometry, leaves, {0.3f, -0.2f, 2.0f});
  EXPECT_TRUE(view.known);
  EXPECT_NEAR(openAround(view, Eigen::Vector3f::UnitZ()), 1.0f, kExact);
  EXPECT_NEAR(openAround(view, -Eigen::Vector3f::UnitZ()), 0.0f, kExact);
}

TEST(LeafOpenness, UprightLeavesSeeHalfTheSkyOnEitherSide) {
  scene::Scene scene = leafScene();
  addPatch(&scene, kLeaf, {1.0f, -1.0f, 2.0f}, {0.0f, 2.0f, 0.0f}, {0.0f, 0.0f, 2.0f});
  std::shared_ptr<const Geometry> geometry;
  const LeafOpenness leaves = opennessOf(scene, &geometry);
  const SkyOpenness view = viewAt(*geometry, leaves, {1.0f, 0.2f, 3.1f});
  for (const float side : {-1.0f, 1.0f})
    EXPECT_NEAR(openAround(view, side * Eigen::Vector3f::UnitX()), 0.5f, kExact);
}

TEST(LeafOpenness, TellsTheSideOfTheSkyThatAWallHides) {
  scene::Scene scene = levelLeaf();
  addPatch(&scene, kBoard, {1.5f, -200.0f, 0.0f}, {0.0f, 400.0f, 0.0f}, {0.0f, 0.0f, 200.0f});
  std::shared_ptr<const Geometry> geometry;
  const LeafOpenness leaves = opennessOf(scene, &geometry);
  const SkyOpenness view = viewAt(*geometry, leaves, {0.3f, -0.2f, 2.0f});
  // 0.06: as kExact, and a wall that ends in the north and south: its last 0.4° of azimuth lie in sectors of
  // 36 and 60°, which are one number each.
  EXPECT_NEAR(openAround(view, Eigen::Vector3f::UnitX()), 0.0f, 0.06f);
  EXPECT_NEAR(openAround(view, -Eigen::Vector3f::UnitX()), 0.5f, 0.06f);
}

TEST(LeafOpenness, TellsEveryPatchThatAWallHides) {
  scene::Scene scene = levelLeaf();
  addPatch(&scene, kBoard, {1.5f, -200.0f, 0.0f}, {0.0f, 400.0f, 0.0f}, {0.0f, 0.0f, 6.0f});
  std::shared_ptr<const Geometry> geometry;
  const LeafOpenness leaves = opennessOf(scene, &geometry);
  const OnLeaf place = onLeaf(*geometry, {0.3f, -0.2f, 2.0f});
  const PatchBytes open = leaves.patches(place.triangle, place.within);
  const SkyPatches patches(1);
  int hidden = 0, clear = 0;
  for (const SkyPatches::Ray& ray : patches.coarseRays()) {
    if (ray.patch == SkyPatches::kBelow) continue;
    // Where it meets the wall's plane above the leaf. 1 m² shares what stands beyond the leaf, so anything
    // from its edge on, 0.5 m from the wall, to 1 m behind the point may ask for it.
    const Eigen::Vector3f& to = ray.towards;
    const float lowest = 0.5f * to.z() / to.x(), highest = 2.2f * to.z() / to.x();
    const int byte = open[static_cast<std::size_t>(ray.patch)];
    if (to.x() > 0.02f && highest < 4.0f) {
      EXPECT_EQ(byte, 0) << to.transpose();
      ++hidden;
    } else if (to.x() < 0.0f || lowest > 4.0f) {
      EXPECT_EQ(byte, 255) << to.transpose();
      ++clear;
    }
  }
  EXPECT_GT(hidden, 60);
  EXPECT_GT(clear, 80);
  EXPECT_EQ(open[SkyPatches::kBelow], 0);
}

TEST(LeafOpenness, ChangesWithinALeafThatAWallCutsInTwo) {
  // Along the foot of a wall without end half of the sky is left, by cosine; behind a wall at distance d of
  // height h, (1 + d / √(d² + h²)) / 2.
  scene::Scene scene = levelLeaf();
  addPatch(&scene, kBoard, {0.0f, -200.0f, 1.0f}, {0.0f, 400.0f, 0.0f}, {0.0f, 0.0f, 1.5f});
  std::shared_ptr<const Geometry> geometry;
  const LeafOpenness leaves = opennessOf(scene, &geometry);
  for (const float x : {-0.9f, -0.55f, -0.2f, 0.2f, 0.55f, 0.9f}) {
    const float distance = std::abs(x);
    const float open = 0.5f * (1.0f + distance / std::hypot(distance, 0.5f));
    // 0.1: between three nodes, on a grid of 0.4 m.
    EXPECT_NEAR(openAround(viewAt(*geometry, leaves, {x, 0.1f, 2.0f}), Eigen::Vector3f::UnitZ()), open, 0.1f)
        << x;
  }
}

TEST(LeafOpenness, HasTheSameBitsOnAnyNumberOfThreads) {
  std::vector<Looked> points;
  const scene::Scene scene = crown(&points);
  std::shared_ptr<const Geometry> geometry;
  const LeafOpenness several = opennessOf(scene, &geometry);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const LeafOpenness one = opennessOf(scene, &geometry);
  EXPECT_FALSE(several.grids.empty());
  EXPECT_EQ(several.grids, one.grids);
  EXPECT_EQ(several.first, one.first);
}

TEST(LeafOpenness, IsNotKeptWhereThereAreNoLeaves) {
  scene::Scene scene = leafScene();
  addGround(&scene, kBoard, 5.0f);
  std::shared_ptr<const Geometry> geometry;
  const LeafOpenness leaves = opennessOf(scene, &geometry);
  EXPECT_FALSE(leaves.known(0));
  EXPECT_TRUE(leaves.first.empty());
}

// Whose two halves, as the bake sees them, have opposite normals.
TEST(LeafOpenness, LightIsFiniteAroundALeafMadeOfAFrontAndABack) {
  scene::Scene scene = leafScene();
  addGround(&scene, kBoard, 4.0f);
  addPatch(&scene, kLeaf, {-0.5f, -0.5f, 1.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.5f});
  scene.meshes.back().triangles = {{0, 1, 2}, {0, 2, 1}};
  TransportOptions options;
  options.samples = 1000;
  const World world = worldOf(std::move(scene));
  const auto transport = Transport::bake(world.geometry, options);
  for (const NodeLight& node : transport->relight(uniformDay(1.0f))) {
    EXPECT_TRUE(node.irradiance.allFinite());
    EXPECT_GE(node.irradiance.minCoeff(), 0.0f);
  }
}

TEST(LeafOpenness, EachSideOfALeafHasLightOfItsOwn) {
  // Under an even sky of 1 cd/m² the upper side of a level leaf gets π lx and the lower one what the ground
  // sends up.
  constexpr float kReflectance = 0.5f;
  scene::Scene scene = leafScene();
  scene.materials[kBoard] = paint(kReflectance);
  addGround(&scene, kBoard, 200.0f);
  addPatch(&scene, kLeaf, {-0.5f, -0.5f, 3.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f});
  const World world = worldOf(std::move(scene));
  const auto transport = Transport::bake(world.geometry, {});
  const Illumination lit = transport->illumination(uniformDay(1.0f));
  const NodeLights& nodes = *lit.nodes;
  const Eigen::Vector3f point(0.2f, 0.1f, 3.0f);
  const std::uint32_t leaf = triangleAt(*world.geometry, point, Eigen::Vector3f::UnitZ());
  const auto light = [&](bool up) {
    const bool front = (world.geometry->planes[leaf].normal.z() > 0.0f) == up;
    const std::array<float, 3> within = Corners(*world.geometry, leaf).within(point);
    return irradianceAt(lightPlace(transport->data().mesh, {leaf, front}, within), nodes)[1];
  };
  EXPECT_NEAR(light(true), kPiFloat, 0.01f * kPiFloat);
  // 8 %: the leaf's own shade, 1 m² seen from 3 m, is 1 / 9π of what it looks at; paint mirrors a little
  // beside the half that it spreads; 160 directions below the horizon.
  EXPECT_NEAR(light(false), kReflectance * kPiFloat, 0.08f * kReflectance * kPiFloat);
}

}  // namespace
}  // namespace sunlit::light
