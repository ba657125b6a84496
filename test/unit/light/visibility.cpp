// Triangles in order, and rays that meet exactly what is there.
#include "sunlit/light/visibility.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace sunlit::light {
namespace {

scene::Material plain(bool double_sided = true) {
  scene::Material material;
  material.double_sided = double_sided;
  return material;
}

/// A level square sheet of 2 m about (x, y), at height z, facing up.
scene::Mesh sheet(int material, float x, float y, float z) {
  scene::Mesh mesh;
  mesh.material = material;
  mesh.positions = {{x - 1, y - 1, z}, {x + 1, y - 1, z}, {x + 1, y + 1, z}, {x - 1, y + 1, z}};
  mesh.normals.assign(4, Eigen::Vector3f::UnitZ());
  mesh.texture_coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

std::shared_ptr<const Geometry> geometryOf(scene::Scene scene) {
  return std::make_shared<const Geometry>(std::make_shared<const scene::Scene>(std::move(scene)));
}

bool blocked(const Visibility& visibility, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) {
  std::uint8_t answer = 2;
  visibility.occluded(
      {&origin.x(), &origin.y(), &origin.z(), &direction.x(), &direction.y(), &direction.z(), 1}, &answer);
  return answer == 1;
}

TEST(Geometry, ChunksHoldEachTriangleOnceByMaterialAndPlace) {
  scene::Scene scene;
  scene.materials = {plain(), plain()};
  for (int i = 0; i < 10; ++i)
    scene.meshes.push_back(sheet(i % 2, 40.0f * static_cast<float>(i), 0.0f, 0.0f));
  const auto geometry = geometryOf(scene);
  EXPECT_EQ(geometry->triangles.size(), 20u);
  std::uint32_t next = 0;
  for (const scene::Chunk& chunk : geometry->chunks) {
    EXPECT_EQ(chunk.first, next);
    next += chunk.count;
    for (std::uint32_t t = chunk.first; t < next; ++t) {
      EXPECT_EQ(geometry->materials[t], chunk.material);
      for (std::uint32_t v : geometry->triangles[t]) EXPECT_TRUE(chunk.box.contains(geometry->positions[v]));
    }
  }
  EXPECT_EQ(next, 20u);
}

TEST(Geometry, LeavesOutTrianglesWithoutAreaAndMarksUnusableNormals) {
  scene::Scene scene;
  scene.materials = {plain()};
  scene.meshes = {sheet(0, 0.0f, 0.0f, 0.0f)};
  scene.meshes[0].triangles.push_back({0, 1, 1});
  scene.meshes[0].normals[0] = Eigen::Vector3f::Zero();
  scene.meshes[0].normals[1] = {std::nanf(""), 0.0f, 1.0f};
  scene.meshes[0].normals[2] = {0.0f, 0.0f, 7.0f};
  const auto geometry = geometryOf(scene);
  EXPECT_EQ(geometry->triangles.size(), 2u);
  EXPECT_EQ(geometry->normals[0].norm(), 0.0f);
  EXPECT_EQ(geometry->normals[1].norm(), 0.0f);
  EXPECT_EQ(geometry->normals[2], Eigen::Vector3f(0.0f, 0.0f, 1.0f));
}

TEST(Rays, AreStoppedFromBothSidesEvenByOneSidedTriangles) {
  scene::Scene scene;
  scene.materials = {plain(false)};
  scene.meshes = {sheet(0, 0.0f, 0.0f, 5.0f)};
  const Visibility visibility(geometryOf(scene));
  EXPECT_TRUE(blocked(visibility, {0.3f, 0.2f, 0.0f}, {0.0f, 0.0f, 1.0f}));
  EXPECT_TRUE(blocked(visibility, {0.3f, 0.2f, 9.0f}, {0.0f, 0.0f, -1.0f}));
  EXPECT_FALSE(blocked(visibility, {1.3f, 0.2f, 0.0f}, {0.0f, 0.0f, 1.0f}));
  EXPECT_FALSE(blocked(visibility, {0.3f, 0.2f, 6.0f}, {0.0f, 0.0f, 1.0f}));
}

TEST(Rays, PassWhereAMaskIsCutOut) {
  scene::Scene scene;
  scene.materials = {plain()};
  scene.materials[0].base_texture = 0;
  scene.materials[0].alpha_mode = scene::AlphaMode::kMask;
  scene::Texture texture{"corner", 4, 4, std::vector<std::uint8_t>(64, 0)};
  texture.rgba.own()[4 * (4 * 0 + 3) + 3] = 255;  // only the top right texel is solid: s near 1, t near 0
  scene.textures = {texture};
  scene.meshes = {sheet(0, 0.0f, 0.0f, 5.0f)};
  const Visibility visibility(geometryOf(scene));
  // That texel's centre: s = 7/8, t = 1/8, or x = 0.75, y = −0.75.
  EXPECT_TRUE(blocked(visibility, {0.75f, -0.75f, 0.0f}, {0.0f, 0.0f, 1.0f}));
  EXPECT_FALSE(blocked(visibility, {-0.75f, -0.75f, 0.0f}, {0.0f, 0.0f, 1.0f}));
  EXPECT_FALSE(blocked(visibility, {0.75f, 0.75f, 0.0f}, {0.0f, 0.0f, 1.0f}));
  EXPECT_FALSE(visibility.firstSeen({0.75f, 0.75f, 0.0f}, {0.0f, 0.0f, 1.0f}, 0.05f));
  EXPECT_TRUE(visibility.firstSeen({0.75f, -0.75f, 0.0f}, {0.0f, 0.0f, 1.0f}, 0.05f));
}

TEST(Rays, OfAnyNumberAreAnsweredInOrder) {
  scene::Scene scene;
  scene.materials = {plain()};
  scene.meshes = {sheet(0, 0.0f, 0.0f, 5.0f)};
  const Visibility visibility(geometryOf(scene));
  for (const std::size_t count : {0u, 1u, 7u, 8u, 9u, 100u}) {
    std::vector<float> x(count), y(count, 0.1f), zero(count, 0.0f), up(count, 1.0f);
    for (std::size_t i = 0; i < count; ++i) x[i] = i % 3 == 0 ? 0.2f : 3.0f;
    std::vector<std::uint8_t> answer(count + 1, 7);
    visibility.occluded({x.data(), y.data(), zero.data(), zero.data(), zero.data(), up.data(), count},
                        answer.data());
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(answer[i], i % 3 == 0 ? 1 : 0) << i << " of " << count;
    EXPECT_EQ(answer[count], 7);
  }
}

TEST(Closest, TellsTriangleAndPlaceFromEitherSideAndPassesCutOuts) {
  scene::Scene scene;
  scene.materials = {plain(false), plain()};
  scene.materials[1].base_texture = 0;
  scene.materials[1].alpha_mode = scene::AlphaMode::kMask;
  scene.textures = {{"clear", 1, 1, {255, 255, 255, 0}}};
  scene.meshes = {sheet(0, 0.0f, 0.0f, 5.0f), sheet(1, 0.0f, 0.0f, 3.0f)};
  const auto geometry = geometryOf(scene);
  const Visibility visibility(geometry);
  // From below (its back, through the sheet that is all cut out), from above, and past it.
  const std::array<float, 3> x = {0.3f, -0.6f, 4.0f}, y = {-0.2f, 0.1f, 0.0f}, z = {1.0f, 9.0f, 0.0f};
  const std::array<float, 3> dx = {0.0f, 0.0f, 0.0f}, dy = dx, dz = {2.0f, -1.0f, 1.0f};
  std::array<Hit, 3> hits;
  visibility.closest({x.data(), y.data(), z.data(), dx.data(), dy.data(), dz.data(), 3}, hits.data());
  EXPECT_FLOAT_EQ(hits[0].distance, 2.0f);  // 4 m, in lengths of the direction
  EXPECT_FLOAT_EQ(hits[1].distance, 4.0f);
  EXPECT_EQ(hits[2].triangle, Hit::kMiss);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_NE(hits[i].triangle, Hit::kMiss);
    const auto& corners = geometry->triangles[hits[i].triangle];
    const Eigen::Vector3f point = (1.0f - hits[i].u - hits[i].v) * geometry->positions[corners[0]] +
                                  hits[i].u * geometry->positions[corners[1]] +
                                  hits[i].v * geometry->positions[corners[2]];
    EXPECT_NEAR((point - Eigen::Vector3f(x[i], y[i], 5.0f)).norm(), 0.0f, 1e-5f);  // single precision
  }
}

TEST(FirstSeen, IsTheNearestVisibleTriangle) {
  scene::Scene scene;
  scene.materials = {plain(false), plain(true)};
  scene.meshes = {sheet(0, 0.0f, 0.0f, 5.0f), sheet(1, 0.0f, 0.0f, 8.0f)};  // the lower one faces up
  const auto geometry = geometryOf(scene);
  const Visibility visibility(geometry);
  const auto height = [&](const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float near) {
    const auto triangle = visibility.firstSeen(origin, direction, near);
    return triangle ? geometry->positions[geometry->triangles[*triangle][0]].z() : -1.0f;
  };
  EXPECT_EQ(height({0.1f, 0.2f, 0.0f}, {0.0f, 0.0f, 1.0f}, 0.05f),
            8.0f);  // through the back of the lower one
  EXPECT_EQ(height({0.1f, 0.2f, 9.0f}, {0.0f, 0.0f, -1.0f}, 0.05f), 8.0f);
  EXPECT_EQ(height({0.1f, 0.2f, 9.0f}, {0.0f, 0.0f, -1.0f}, 2.0f), 5.0f);
  EXPECT_EQ(height({5.0f, 0.2f, 9.0f}, {0.0f, 0.0f, -1.0f}, 0.05f), -1.0f);
}

TEST(Visibility, LetsRaysPassWhatBlendsIfSoWished) {
  scene::Scene scene;
  scene.materials = {plain(), plain()};
  scene.materials[1].alpha_mode = scene::AlphaMode::kBlend;
  scene.materials[1].alpha = 0.5f;
  scene.meshes = {sheet(0, 0.0f, 0.0f, 2.0f), sheet(1, 0.5f, 0.0f, 1.0f)};
  const Visibility visibility(geometryOf(scene));
  // Rays up from the ground: below both sheets, below the one that blends alone, and beside both.
  const std::vector<float> x(200, 0.2f), beside(200, 1.2f), none(200, 5.0f), zero(200, 0.0f), one(200, 1.0f);
  std::vector<float> y;
  for (int i = 0; i < 200; ++i) y.push_back(-0.9f + 0.009f * static_cast<float>(i));
  const auto stopped = [&](const std::vector<float>& at_x, Visibility::Blends blends) {
    std::vector<std::uint8_t> blocked(200, 7);
    visibility.occluded({at_x.data(), y.data(), zero.data(), zero.data(), zero.data(), one.data(), 200},
                        blocked.data(), blends);
    return std::accumulate(blocked.begin(), blocked.end(), 0);
  };
  using Blends = Visibility::Blends;
  EXPECT_EQ(stopped(x, Blends::kLetPass), 200);
  EXPECT_EQ(stopped(x, Blends::kStopByChance), 200);
  EXPECT_EQ(stopped(beside, Blends::kLetPass), 0);
  EXPECT_NEAR(stopped(beside, Blends::kStopByChance), 100, 4 * 7.1);  // √(200 · 0.5 · 0.5)
  EXPECT_EQ(stopped(none, Blends::kStopByChance), 0);
  // The nearest is what blends where it stops the ray, else what lies behind.
  std::vector<Hit> hits(200);
  visibility.closest({x.data(), y.data(), zero.data(), zero.data(), zero.data(), one.data(), 200},
                     hits.data());
  int blending = 0;
  for (const Hit& hit : hits) {
    const bool blends = visibility.fixedGeometry().materials[hit.triangle] == 1;
    EXPECT_FLOAT_EQ(hit.distance, blends ? 1.0f : 2.0f);
    blending += blends ? 1 : 0;
  }
  EXPECT_NEAR(blending, 100, 4 * 7.1);
}

TEST(Veils, AreDarkByWhatTheyTakeOfRaysThatPass) {
  scene::Scene scene;
  scene.materials = {plain()};
  scene.meshes = {sheet(0, 0.0f, 0.0f, 2.0f)};
  scene::Material& material = scene.materials[0];
  const auto dark = [&scene] { return Visibility(geometryOf(scene)).hasDarkVeils(); };
  EXPECT_FALSE(dark());
  material.base_color = LinearRgb(1.0f, 1.0f, 1.0f);
  material.glass = 1.0f;
  EXPECT_FALSE(dark());
  material.base_color = LinearRgb(1.0f, 0.5f, 1.0f);
  EXPECT_TRUE(dark());
  material.glass = 0.0f;
  material.alpha_mode = scene::AlphaMode::kBlend;
  material.alpha = 0.1f;
  EXPECT_FALSE(dark());
  material.alpha = 1.0f;
  EXPECT_TRUE(dark());
  // Rays pass what is cut out by its texture, or are stopped, and none is dimmed.
  scene::Texture leaf;
  leaf.width = 2;
  leaf.height = 1;
  leaf.rgba.own() = {255, 255, 255, 255, 255, 255, 255, 0};
  scene.textures = {leaf};
  material.base_texture = 0;
  EXPECT_FALSE(dark());
}

TEST(Veils, AreMetFromWhereverRaysCome) {
  // A level and an upright pane, far from each other.
  scene::Scene scene;
  scene.materials = {plain()};
  scene.materials[0].glass = 1.0f;
  scene.meshes = {sheet(0, -100.0f, 30.0f, 2.0f), sheet(0, 80.0f, -60.0f, 0.0f)};
  for (Eigen::Vector3f& position : scene.meshes[1].positions) std::swap(position.y(), position.z());
  const auto geometry = geometryOf(scene);
  const Visibility visibility(geometry);
  std::mt19937 random(7);
  const auto within = [&](float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
  };
  constexpr float kEndless = std::numeric_limits<float>::infinity();
  std::vector<Hit> hits;
  for (std::size_t i = 0; i < 2000; ++i) {
    // To a point within a triangle, also near its corners; some along axes, of which one is the pane's own.
    const auto& corners = geometry->triangles[i % 4];
    const float a = i % 2 == 0 ? 1e-3f : within(1e-3f, 0.998f), b = within(1e-3f, 0.999f - a);
    const Eigen::Vector3f& first = geometry->positions[corners[0]];
    const Eigen::Vector3f at =
        first + a * (geometry->positions[corners[1]] - first) + b * (geometry->positions[corners[2]] - first);
    Eigen::Vector3f origin(within(-1000.0f, 1000.0f), within(-1000.0f, 1000.0f), within(-900.0f, 900.0f));
    if (i % 5 == 0) origin.head<2>() = at.head<2>();
    if (i % 5 == 1) origin.tail<2>() = at.tail<2>();
    const Eigen::Vector3f way = at - origin;
    if (std::abs(geometry->planes[i % 4].normal.dot(way)) < 0.01f * way.norm()) continue;
    visibility.veils({origin, way, 0.0f, 1.001f}, &hits);
    EXPECT_GE(hits.size(), 1u) << i;
    visibility.veils({origin, way.normalized(), 0.0f, kEndless}, &hits);
    EXPECT_GE(hits.size(), 1u) << i;
    visibility.veils({origin, -way, 0.0f, kEndless}, &hits);
    EXPECT_EQ(hits.size(), 0u) << i;
  }
}

}  // namespace
}  // namespace sunlit::light
