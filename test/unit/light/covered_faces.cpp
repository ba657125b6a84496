#include "light/bake/samples/covered_faces.h"

#include <gtest/gtest.h>

#include "light/bake/samples/bake_rays.h"
#include "light/bake/samples/triangle_kinds.h"
#include "paper_scene.h"

namespace sunlit::light {
namespace {

const Eigen::Vector3f kUp = Eigen::Vector3f::UnitZ(), kEast = Eigen::Vector3f::UnitX(),
                      kNorth = Eigen::Vector3f::UnitY();

/// A box of 2 m × 2 m × 1 m on 100 m of level ground.
std::shared_ptr<const Geometry> boxOnGround() {
  scene::Scene scene;
  scene.materials = {paint(0.3f)};
  addPatch(&scene, 0, {-50.0f, -50.0f, 0.0f}, 100.0f * kEast, 100.0f * kNorth);
  addBlock(&scene, 0, {-1.0f, -1.0f, 0.0f}, {2.0f, 2.0f, 1.0f});
  return worldOf(std::move(scene)).geometry;
}

/// A closed room of walls without thickness, each of two sheets back to back; the outer ones are cut along
/// the other diagonal.
std::shared_ptr<const Geometry> paperRoom() {
  scene::Scene scene;
  scene.materials = {paint(0.3f)};
  const Eigen::Vector3f low(-2.0f, -2.0f, 0.0f), east = 4.0f * kEast, north = 4.0f * kNorth, up = 3.0f * kUp;
  const auto wall = [&](const Eigen::Vector3f& corner, const Eigen::Vector3f& u, const Eigen::Vector3f& v) {
    addPatch(&scene, 0, corner, u, v);       // seen from where u × v points
    addPatch(&scene, 0, corner + u, -u, v);  // and from the other side
  };
  wall(low, east, north);
  wall(low + up, north, east);
  wall(low, north, up);
  wall(low + east, up, north);
  wall(low, up, east);
  wall(low + north, east, up);
  return worldOf(std::move(scene)).geometry;
}

TEST(CoveredFaces, TheGroundIsCoveredInPartAndTheBottomOnItWhole) {
  const auto geometry = boxOnGround();
  const std::vector<Cover> found = covers(RayScene(geometry));
  ASSERT_EQ(found.size(), geometry->triangles.size());
  for (std::uint32_t t = 0; t < found.size(); ++t) {
    const auto& corners = geometry->triangles[t];
    float top = -1e9f, widest = 0.0f;
    for (const std::uint32_t corner : corners) {
      top = std::max(top, geometry->positions[corner].z());
      widest = std::max(widest, geometry->positions[corner].cwiseAbs().maxCoeff());
    }
    const Cover expected = top > 0.0f ? Cover::kNone : widest > 10.0f ? Cover::kPart : Cover::kWhole;
    EXPECT_EQ(found[t], expected) << t;
  }
}

TEST(CoveredFaces, RaysFromWithinABoxMeetItsBottom) {
  const auto geometry = boxOnGround();
  const BakeRays rays(geometry);
  RayPacket packet;
  for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
    const float x = -0.9f + 0.11f * static_cast<float>(i);
    packet.set(i, {x, 0.3f, 0.5f}, Eigen::Vector3f(0.1f * x, -0.3f, -1.0f) * 3.0f, true);
  }
  HitPacket hits;
  rays.cast(packet, &hits);
  for (const std::uint32_t hit : hits.triangle) {
    ASSERT_NE(hit, HitPacket::kNothing);
    EXPECT_LT(geometry->planes[hit].normal.z(), -0.9f);
  }
  // Whoever stands on the ground sees it.
  for (std::size_t i = 0; i < RayPacket::kSize; ++i)
    packet.set(i, {1.001f + static_cast<float>(i), 0.3f, 0.5f}, -kUp, true);
  rays.cast(packet, &hits);
  for (const std::uint32_t hit : hits.triangle) EXPECT_GT(geometry->planes[hit].normal.z(), 0.9f);
  // And nothing of the box's inside is ever seen.
  const std::vector<TriangleTraits> traits = triangleTraits(*geometry, rays);
  for (std::uint32_t t = 0; t < traits.size(); ++t) {
    if (geometry->positions[geometry->triangles[t][0]].cwiseAbs().maxCoeff() < 10.0f) {
      EXPECT_FALSE(traits[t].used[1]) << t;
    }
  }
}

TEST(CoveredFaces, BothSidesOfAWallWithoutThicknessAreSeen) {
  const auto geometry = paperRoom();
  const std::vector<Cover> found = covers(RayScene(geometry));
  ASSERT_EQ(found.size(), geometry->triangles.size());
  for (const Cover cover : found) EXPECT_EQ(cover, Cover::kWhole);
  const BakeRays rays(geometry);
  int inside = 0;
  const std::vector<TriangleTraits> traits = triangleTraits(*geometry, rays);
  for (std::uint32_t t = 0; t < traits.size(); ++t) {
    const Eigen::Vector3f to_middle =
        Eigen::Vector3f(0.0f, 0.0f, 1.5f) - geometry->positions[geometry->triangles[t][0]];
    const bool inwards = geometry->planes[t].normal.dot(to_middle) > 0.0f;
    inside += inwards ? 1 : 0;
    // Whoever is in the room sees the inner sheet.
    EXPECT_TRUE(!inwards || traits[t].used[0]) << t;
  }
  EXPECT_EQ(inside, 12);
}

TEST(CoveredFaces, AreNoneWhereThingsStandApart) {
  scene::Scene scene;
  scene.materials = {paint(0.3f)};
  addPatch(&scene, 0, {-50.0f, -50.0f, 0.0f}, 100.0f * kEast, 100.0f * kNorth);
  addBlock(&scene, 0, {-1.0f, -1.0f, 0.01f}, {2.0f, 2.0f, 1.0f});
  EXPECT_TRUE(covers(RayScene(worldOf(std::move(scene)).geometry)).empty());
}

}  // namespace
}  // namespace sunlit::light
