// Rays that are cast only where they tell more, against all of them.
#include "light/bake/samples/adaptive_probe.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <set>
#include <vector>

#include "light/bake/samples/triangle_kinds.h"
#include "paper_scene.h"

namespace sunlit::light {
namespace {

constexpr int kPatchRays = 3;  // a patch

/// What a point on the ground sees of the sky.
struct Outcome {
  std::vector<float> open = std::vector<float>(SkyPatches::kCount, 0.0f);  ///< weight of each patch
  std::set<std::size_t> rays;                                              ///< that were cast
  float all = 0.0f;                                                        ///< weights
  void add(std::size_t ray, int patch, float weight, bool free) {
    rays.insert(ray);
    all += weight;
    if (free) open[static_cast<std::size_t>(patch)] += weight;
  }
  double openness() const {
    double sum = 0.0;
    for (const float weight : open) sum += static_cast<double>(weight);
    return sum / kPi;
  }
  /// Share of the light that is told otherwise than by `other`, patch by patch.
  double wrong(const Outcome& other) const {
    double sum = 0.0;
    for (std::size_t p = 0; p < open.size(); ++p)
      sum += static_cast<double>(std::abs(open[p] - other.open[p]));
    return sum / kPi;
  }
};

struct Both {
  Outcome adaptive, whole;
};

/// Looks up from `origin` on level ground.
Both lookUp(scene::Scene scene, const Eigen::Vector3f& origin) {
  const auto geometry =
      std::make_shared<const Geometry>(std::make_shared<const scene::Scene>(std::move(scene)));
  const BakeRays rays(geometry);
  const std::vector<TriangleTraits> traits = triangleTraits(*geometry, rays);
  const SkyPatches patches(kPatchRays);
  Receiver receiver;
  receiver.origins.fill(origin);
  receiver.lifts.fill(0.005f * Eigen::Vector3f::UnitZ());
  receiver.normal = Eigen::Vector3f::UnitZ();
  const ReceiverGroup receivers(&receiver, 1);
  Both both;
  const auto into = [&](Outcome* to) {
    return [&patches, to](int i, std::size_t r, float weight, const HitLayers& hits) {
      to->add(r, patches.rays()[r].patch, weight, hits.ends.triangle[i] == HitPacket::kNothing);
    };
  };
  AdaptiveProbe(rays, traits, patches).look(receivers, into(&both.adaptive));
  probe(rays, patches.rays(), receivers, into(&both.whole));
  return both;
}

scene::Scene ground() {
  scene::Scene scene;
  scene.materials = {paint(0.5f)};
  addGround(&scene, 0, 200.0f);
  return scene;
}

TEST(ReceiverGroup, WeighsEachReceiverToTheBit) {
  const SkyPatches patches(kPatchRays);
  std::vector<Receiver> receivers(5);
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const auto turn = static_cast<float>(i);
    receivers[i].normal = Eigen::Vector3f(0.3f + turn, 0.7f - turn, 0.4f).normalized();
    if (i % 2 == 1) receivers[i].face = Eigen::Vector3f(0.1f, turn, -0.9f).normalized();
    receivers[i].transmission = 0.15f * turn;
  }
  const ReceiverGroup group(receivers.data(), static_cast<int>(receivers.size()));
  std::array<float, RayPacket::kSize> weights;
  for (const SkyPatches::Ray& ray : patches.rays()) {
    const ReceiverGroup::Lanes lanes = group.weigh(ray.towards, weights.data());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const float expected = i < receivers.size() ? receivers[i].weight(ray.towards) : 0.0f;
      EXPECT_EQ(weights[i], expected) << i;
      EXPECT_EQ(ReceiverGroup::has(lanes, static_cast<int>(i)), expected > 0.0f) << i;
    }
  }
}

TEST(AdaptiveProbe, SeesAnOpenSkyAsAllRaysDo) {
  const Both both = lookUp(ground(), {1.0f, 2.0f, 0.0f});
  // The same products, added in another order.
  for (std::size_t p = 0; p < both.whole.open.size(); ++p)
    EXPECT_NEAR(both.adaptive.open[p], both.whole.open[p], 1e-6f) << p;
  // One ray a patch, and all along the horizon.
  EXPECT_EQ(both.adaptive.rays.size(),
            static_cast<std::size_t>(SkyPatches::kAbove + (kPatchRays - 1) * SkyPatches::kRings[0].patches));
  EXPECT_EQ(both.whole.rays.size(), static_cast<std::size_t>(kPatchRays * SkyPatches::kAbove));
}

TEST(AdaptiveProbe, FindsTheEdgeOfAWall) {
  for (const float distance : {0.3f, 1.0f, 4.0f}) {
    scene::Scene scene = ground();
    addPatch(&scene, 0, {0.0f, -6.0f, 0.0f}, {0.0f, 12.0f, 0.0f}, {0.0f, 0.0f, 3.0f});
    const Both both = lookUp(std::move(scene), {distance, 0.4f, 0.0f});
    EXPECT_NEAR(both.adaptive.all, both.whole.all, 1e-5f);
    // Every patch that the edge cuts has one beside it of which more is hidden, or less. Where it cuts a
    // corner off so that no coarse ray tells, a third of a patch of 1 % of the light is told wrong: twice at
    // most.
    EXPECT_LT(both.adaptive.wrong(both.whole), 0.007) << distance;
    EXPECT_LT(both.adaptive.rays.size(), both.whole.rays.size() * 2 / 3) << distance;
  }
}

TEST(AdaptiveProbe, AddsUpUnderAFineGrid) {
  // Bars as wide as the gaps, 10 cm from one to the next and 1 m up: patches are wider than that.
  scene::Scene scene = ground();
  for (int i = -100; i < 100; ++i)
    addPatch(&scene, 0, {0.1f * static_cast<float>(i), -10.0f, 1.0f}, {0.0f, 20.0f, 0.0f},
             {0.05f, 0.0f, 0.0f});
  const Both both = lookUp(std::move(scene), {0.02f, 0.3f, 0.0f});
  EXPECT_NEAR(both.adaptive.all, both.whole.all, 1e-5f);
  // By chance the coarse rays of a patch and of the five or so around it agree in one of 32 patches; each of
  // those is off by a third or two of itself, to either side: 0.6 % together, and three times as much at
  // most.
  EXPECT_NEAR(both.adaptive.openness(), both.whole.openness(), 0.02);
}

TEST(AdaptiveProbe, LeavesNoRayOutThatMayMeetLeaves) {
  scene::Texture solid;
  solid.width = solid.height = 2;
  solid.rgba.own().assign(16, 255);
  scene::Scene scene = leafSceneOf(solid);
  addPatch(&scene, 0, {-300.0f, -300.0f, 2.0f}, {600.0f, 0.0f, 0.0f}, {0.0f, 600.0f, 0.0f});
  const Both both = lookUp(std::move(scene), {0.1f, 0.2f, 0.0f});
  EXPECT_EQ(both.adaptive.rays, both.whole.rays);
  EXPECT_NEAR(both.adaptive.all, both.whole.all, 1e-5f);
}

}  // namespace
}  // namespace sunlit::light
