// Rays of the bake that meet glass and what blends.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "light/bake/samples/bake_rays.h"
#include "light/bake/samples/triangle_kinds.h"
#include "paper_scene.h"

namespace sunlit::light {
namespace {

const Eigen::Vector3f kX = Eigen::Vector3f::UnitX(), kY = Eigen::Vector3f::UnitY();

scene::Material blending(float alpha) {
  scene::Material material = paint(0.5f);
  material.alpha_mode = scene::AlphaMode::kBlend;
  material.alpha = alpha;
  return material;
}

/// A square of 2 m about the z axis.
void addSheet(int material, float height_m, scene::Scene* scene) {
  addPatch(scene, material, {-1.0f, -1.0f, height_m}, 2.0f * kX, 2.0f * kY);
}

/// Opaque ground, and above it sheets of such alpha, the first one highest, 1 m from one to the next.
std::shared_ptr<const Geometry> sheetsOf(const std::vector<float>& alphas) {
  scene::Scene scene;
  scene.materials = {paint(0.5f)};
  addSheet(0, 0.0f, &scene);
  auto height_m = static_cast<float>(alphas.size());
  for (const float alpha : alphas) {
    scene.materials.push_back(blending(alpha));
    addSheet(static_cast<int>(scene.materials.size()) - 1, height_m, &scene);
    height_m -= 1.0f;
  }
  return std::make_shared<const Geometry>(std::make_shared<const scene::Scene>(std::move(scene)));
}

/// Straight down, a few centimetres apart.
RayPacket raysDown(const Eigen::Vector3f& from) {
  RayPacket rays;
  for (std::size_t i = 0; i < kPacket; ++i)
    rays.set(i, from + 0.031f * static_cast<float>(i) * kX, -Eigen::Vector3f::UnitZ(), true);
  return rays;
}

TEST(BakeVeils, ShareTheLightOfARayInTheirOrder) {
  const auto geometry = sheetsOf({0.5f, 0.25f});
  const BakeRays rays(geometry);
  HitLayers layers;
  rays.cast(raysDown({0.0f, 0.17f, 10.0f}), &layers);
  for (int i = 0; i < RayPacket::kSize; ++i) {
    std::vector<std::pair<float, float>> met;  // distance, share
    layers.visit(i, [&](const HitPacket& hits, float share, PackedTint tint) {
      met.emplace_back(hits.distance[i], share);
      EXPECT_TRUE(tint.white());
    });
    ASSERT_EQ(met.size(), 3u);
    const float expected[3][2] = {{8.0f, 0.5f}, {9.0f, 0.125f}, {10.0f, 0.375f}};
    for (std::size_t k = 0; k < met.size(); ++k) {
      EXPECT_NEAR(met[k].first, expected[k][0], 1e-5f);
      EXPECT_NEAR(met[k].second, expected[k][1], 1e-6f);
    }
  }
  rays.cast(raysDown({0.0f, 5.0f, 10.0f}), &layers);
  EXPECT_TRUE(layers.veils.empty());
  for (int i = 0; i < RayPacket::kSize; ++i) {
    EXPECT_EQ(layers.ends.triangle[i], HitPacket::kNothing);
    EXPECT_EQ(layers.shareOfEnd(i), 1.0f);
  }
}

TEST(BakeVeils, EndRaysWhereNextToNothingComesThrough) {
  struct Case {
    std::vector<float> alphas;
    std::size_t veils;
    float end_m;  ///< height
    float share;
  };
  // Of twelve halves nine leave 1 in 512, and the tenth less than a thousandth.
  for (const Case& one :
       {Case{{0.5f, 1.0f, 0.5f}, 1, 2.0f, 0.5f}, {std::vector<float>(12, 0.5f), 9, 3.0f, 1.0f / 512}}) {
    const BakeRays rays(sheetsOf(one.alphas));
    HitLayers layers;
    rays.cast(raysDown({0.0f, 0.17f, 20.0f}), &layers);
    EXPECT_EQ(layers.veils.size(), one.veils);
    for (int i = 0; i < RayPacket::kSize; ++i) {
      EXPECT_NEAR(layers.ends.distance[i], 20.0f - one.end_m, 1e-5f);
      EXPECT_NEAR(layers.shareOfEnd(i), one.share, 1e-6f);
    }
  }
}

TEST(BakeVeils, StopByChanceAsManyRaysAsTheyKeepLightBack) {
  const BakeRays rays(sheetsOf({0.5f, 0.25f}));
  constexpr int kPackets = 250;
  float stopped[3] = {0.0f, 0.0f, 0.0f}, hidden = 0.0f;
  for (int p = 0; p < kPackets; ++p) {
    const Eigen::Vector3f from(-0.9f, -0.9f + 1.8f * static_cast<float>(p) / kPackets, 10.0f);
    HitPacket hits;
    rays.cast(raysDown(from), &hits);
    for (const float distance : hits.distance) stopped[std::lround(distance) - 8] += 1.0f;
    std::vector<std::uint8_t> stand_in_the_way;
    rays.hide({{from, {0.0f, 0.0f, -10.0f}, 0.95f}}, &stand_in_the_way);
    hidden += static_cast<float>(stand_in_the_way[0]);
  }
  // Of 4,000 rays a share of a half has a standard deviation of 0.008, of 250 one of 0.03.
  const float expected[3] = {0.5f, 0.125f, 0.375f};
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(stopped[k] / (16.0f * kPackets), expected[k], 0.03f) << k;
  EXPECT_NEAR(hidden / kPackets, 0.625f, 0.12f);
}

TEST(BakeVeils, CountWhereTheyLieOnWhatEndsARay) {
  // A rug of two faces on the ground, some way off: which of two faces at one place is nearer is up to
  // rounding.
  scene::Scene scene;
  scene.materials = {paint(0.5f), blending(0.5f)};
  const Eigen::Vector3f corner(731.3f, -402.7f, 0.0f);
  addPatch(&scene, 0, corner - 3.0f * (kX + kY), 8.0f * kX, 8.0f * kY);
  addBlock(&scene, 1, corner, {1.0f, 1.0f, 0.01f});
  const BakeRays rays(
      std::make_shared<const Geometry>(std::make_shared<const scene::Scene>(std::move(scene))));
  for (int k = 0; k < 40; ++k) {
    HitLayers layers;
    RayPacket down = raysDown(corner + Eigen::Vector3f(0.2f, 0.02f * static_cast<float>(k) + 0.1f, 4.7f));
    std::fill_n(down.towards_x, RayPacket::kSize, 0.05f);
    rays.cast(down, &layers);
    ASSERT_EQ(layers.veils.size(), 2u) << k;
    for (int i = 0; i < RayPacket::kSize; ++i) EXPECT_NEAR(layers.shareOfEnd(i), 0.25f, 1e-6f) << k;
  }
}

TEST(BakeVeils, MakeNoBodiesButWhereTheyAreOpaque) {
  for (const bool opaque : {false, true}) {
    scene::Scene scene;
    scene::Texture texture;  // right half 0.3
    texture.width = texture.height = 2;
    texture.rgba.own() = {255, 255, 255, 255, 255, 255, 255, 77, 255, 255, 255, 255, 255, 255, 255, 77};
    scene.textures.push_back(texture);
    scene.materials = {paint(0.5f), blending(1.0f)};
    scene.materials[1].base_texture = 0;
    addBlock(&scene, 1, {0.0f, 0.0f, 0.5f}, {1.5f, 1.5f, 1.5f});
    for (scene::Mesh& mesh : scene.meshes)
      mesh.texture_coordinates.assign(mesh.positions.size(), {opaque ? 0.25f : 0.75f, 0.5f});
    const auto geometry =
        std::make_shared<const Geometry>(std::make_shared<const scene::Scene>(std::move(scene)));
    const std::vector<TriangleTraits> traits = triangleTraits(*geometry, BakeRays(geometry));
    for (const TriangleTraits& triangle : traits) EXPECT_EQ(triangle.solid, opaque);
  }
}

}  // namespace
}  // namespace sunlit::light
