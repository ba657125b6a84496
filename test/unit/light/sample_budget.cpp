// How many samples a bake takes, and that far places never share one.
#include <gtest/gtest.h>

#include <array>

#include "baked_scene.h"
#include "light/bake/samples/mesh_leaves.h"

namespace sunlit::light {
namespace {

std::size_t samplesOf(scene::Scene scene, int samples) {
  TransportOptions options;
  options.samples = samples;
  options.bounces = 1;
  return baked(std::move(scene), options).transport->sampleCount();
}

/// Plates of 0.3 m that lean in all directions, `side` × `side` of them, far enough apart that none could
/// share a sample of the usual spacing.
scene::Scene plates(int side) {
  scene::Scene scene;
  scene.materials = {paint(0.4f)};
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      const float lean = 0.05f * static_cast<float>((x + 2 * y) % 3);
      addPatch(&scene, 0, {0.5f * static_cast<float>(x), 0.5f * static_cast<float>(y), 1.0f},
               {0.3f, 0.0f, lean}, {0.0f, 0.3f, lean});
    }
  }
  return scene;
}

TEST(SampleBudget, HoldsForScenesOfSmallTriangles) {
  EXPECT_GT(samplesOf(plates(60), 800000), 14400u);  // a sample a corner and side
  EXPECT_LT(samplesOf(plates(60), 5000), 8000u);
}

TEST(SampleBudget, IsNotSpentOnAPlainOfTensOfKilometres) {
  scene::Scene scene;
  scene.materials = {paint(0.3f), paint(0.5f)};
  addGround(&scene, 0, 25000.0f);
  addBlock(&scene, 1, {-5.0f, -5.0f, 0.0f}, {10.0f, 10.0f, 8.0f});
  EXPECT_LT(samplesOf(std::move(scene), 800000), 150000u);
}

TEST(SampleBudget, IsSharedBetweenEqualPlacesWhereItBinds) {
  // Two yards of blocks, one after the other in the scene, that would take more than there is.
  scene::Scene scene;
  scene.materials = {paint(0.3f)};
  for (const float middle : {-200.0f, 200.0f}) {
    addPatch(&scene, 0, {middle - 60.0f, -60.0f, 0.0f}, {120.0f, 0.0f, 0.0f}, {0.0f, 120.0f, 0.0f});
    for (int x = 0; x < 8; ++x)
      for (int y = 0; y < 8; ++y)
        addBlock(
            &scene, 0,
            {middle + 12.0f * static_cast<float>(x) - 50.0f, 12.0f * static_cast<float>(y) - 50.0f, 0.0f},
            {4.0f, 5.0f, 3.0f});
  }
  TransportOptions options;
  options.samples = 20000;
  options.bounces = 1;
  const World world = baked(scene, options);
  const LightMesh& mesh = world.transport->data().mesh;
  std::array<int, 2> cells{};
  for (std::uint32_t t = 0; t < mesh.roots.size(); ++t) {
    const bool second = world.geometry->positions[world.geometry->triangles[t][0]].x() > 0.0f;
    for (const std::uint32_t root : mesh.roots[t]) {
      if (!LightMesh::isCell(root)) continue;
      visitLeaves(mesh, root, Eigen::Matrix3f::Identity(),
                  [&](const LightMesh::Cell&, const Eigen::Matrix3f&) { ++cells[second ? 1 : 0]; });
    }
  }
  EXPECT_NEAR(static_cast<double>(cells[1]) / cells[0], 1.0, 0.08) << cells[0];
}

TEST(SampleBudget, PostsOfEqualHeightHaveLightOfTheirOwn) {
  // The second stands in a shed. Their distance is 2¹⁸ times the 3 cm within which corners share a node.
  const auto post = [](scene::Scene* scene, float x) {
    addBlock(scene, 1, {x, 0.0f, 0.2f}, {0.1f, 0.1f, 0.5f});
  };
  constexpr float kAway_m = 7864.32f;
  scene::Scene scene;
  scene.materials = {paint(0.3f), paint(0.5f)};
  addGround(&scene, 0, 10000.0f);
  post(&scene, 0.0f);
  post(&scene, kAway_m);
  addBlock(&scene, 0, {kAway_m - 3.0f, -3.0f, 2.0f}, {6.0f, 6.0f, 0.2f});
  addBlock(&scene, 0, {kAway_m - 3.0f, -3.0f, 0.0f}, {0.2f, 6.0f, 2.0f});
  addBlock(&scene, 0, {kAway_m + 2.8f, -3.0f, 0.0f}, {0.2f, 6.0f, 2.0f});
  TransportOptions options;
  options.samples = 100000;
  options.bounces = 1;
  const World world = baked(scene, options);
  const auto top = [](float x) {
    return Looked{{x + 0.05f, 0.05f, 0.7f}, Eigen::Vector3f::UnitZ(), Eigen::Vector3f::UnitZ(), 1};
  };
  const std::vector<double> seen = fast(world, {top(0.0f), top(kAway_m)}, uniformDay(100.0f));
  EXPECT_LT(seen[1], 0.5 * seen[0]);
}

}  // namespace
}  // namespace sunlit::light
