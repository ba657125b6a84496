// The solids of SDF have the areas and volumes of geometry, and look outwards.
#include "scene/primitives.h"

#include <gtest/gtest.h>

#include "sunlit/quantity/angle.h"
#include "unit/scene/measure.h"

namespace sunlit::scene {
namespace {

/// With a step of h = 2π/48 the polygon around a round solid has h²/6 = 0.29 % less area than its circle, and
/// straight lines between the rings of a sphere cost h²/4 = 0.43 % more.
constexpr double kFacets = 0.0075;
constexpr double kFloat = 1e-6;  // relative rounding of float positions of size 1, summed over a few faces

/// Shading normals lean to the side that faces look to.
void expectOutward(const Mesh& mesh) {
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t corner : triangle) {
      EXPECT_NEAR(mesh.normals[corner].norm(), 1.0f, 1e-5f);
      EXPECT_GT(mesh.normals[corner].cast<double>().dot(faceVector(mesh, triangle)), 0.0);
    }
  }
}

TEST(Primitives, BoxHasSixFacesLookingOutwards) {
  const Mesh box = makeBox({1.0, 2.0, 3.0});
  EXPECT_EQ(box.triangles.size(), 12u);
  EXPECT_NEAR(volumeOf(box), 6.0, 6.0 * kFloat);
  EXPECT_NEAR(areaOf(box), 22.0, 22.0 * kFloat);
  expectOutward(box);
}

/// What of a texture is at a corner of a mesh, on the side with that normal.
Eigen::Vector2f textureAt(const Mesh& mesh, const Eigen::Vector3f& corner, const Eigen::Vector3f& normal) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if ((mesh.positions[i] - corner).norm() < 1e-5f && (mesh.normals[i] - normal).norm() < 1e-5f)
      return mesh.texture_coordinates[i];
  return {-1.0f, -1.0f};
}

/// What of a texture lies at the corner that is seen at its top left, and top right.
void expectTop(const Mesh& mesh, const Eigen::Vector3f& normal, const Eigen::Vector3f& left,
               const Eigen::Vector3f& right) {
  EXPECT_EQ(textureAt(mesh, left, normal), Eigen::Vector2f(0.0f, 0.0f)) << normal.transpose();
  EXPECT_EQ(textureAt(mesh, right, normal), Eigen::Vector2f(1.0f, 0.0f)) << normal.transpose();
}

TEST(Primitives, TexturesLieAsInGazebo) {
  // By the vertices that gz-common's MeshManager writes.
  const Mesh box = makeBox({2.0, 2.0, 2.0});
  expectTop(box, {0, -1, 0}, {-1, -1, 1}, {1, -1, 1});
  expectTop(box, {0, 1, 0}, {1, 1, 1}, {-1, 1, 1});
  expectTop(box, {-1, 0, 0}, {-1, 1, 1}, {-1, -1, 1});
  expectTop(box, {1, 0, 0}, {1, -1, 1}, {1, 1, 1});
  expectTop(box, {0, 0, 1}, {1, 1, 1}, {1, -1, 1});
  expectTop(box, {0, 0, -1}, {-1, 1, -1}, {-1, -1, -1});
  const Mesh cylinder = makeCylinder(1.0, 2.0);
  EXPECT_EQ(textureAt(cylinder, {0, 1, -1}, {0, 1, 0}), Eigen::Vector2f(0.0f, 0.0f));
  EXPECT_EQ(textureAt(cylinder, {1, 0, 1}, {1, 0, 0}), Eigen::Vector2f(0.25f, 1.0f));
  EXPECT_EQ(textureAt(cylinder, {1, 0, 1}, {0, 0, 1}), Eigen::Vector2f(0.25f, 1.0f));
  EXPECT_EQ(textureAt(cylinder, {0, 0, 1}, {0, 0, 1}), Eigen::Vector2f(0.0f, 0.0f));
  const Mesh sphere = makeEllipsoid({1.0, 1.0, 1.0});
  EXPECT_EQ(textureAt(sphere, {0, 1, 0}, {0, 1, 0}), Eigen::Vector2f(0.0f, 0.0f));
  EXPECT_EQ(textureAt(sphere, {0, 0, 1}, {0, 0, 1}), Eigen::Vector2f(0.0f, 0.5f));
  EXPECT_EQ(textureAt(sphere, {1, 0, 0}, {1, 0, 0}), Eigen::Vector2f(0.25f, 0.5f));
}

TEST(Primitives, CylinderStandsOnZ) {
  const Mesh cylinder = makeCylinder(0.5, 4.0);
  EXPECT_NEAR(volumeOf(cylinder), kPi * 0.25 * 4.0, kFacets * kPi);
  EXPECT_NEAR(areaOf(cylinder), 2 * kPi * 0.25 + kPi * 4.0, kFacets * kPi * 4.5);
  EXPECT_FLOAT_EQ(boundsOf(cylinder).max().z(), 2.0f);
  expectOutward(cylinder);
}

TEST(Primitives, EllipsoidFillsItsBounds) {
  const Mesh ellipsoid = makeEllipsoid({1.0, 2.0, 0.5});
  const double volume = 4.0 / 3.0 * kPi * 1.0;
  EXPECT_NEAR(volumeOf(ellipsoid), volume, kFacets * volume);
  EXPECT_LT((boundsOf(ellipsoid).max() - Eigen::Vector3f(1.0f, 2.0f, 0.5f)).norm(), 1e-5f);
  expectOutward(ellipsoid);
}

TEST(Primitives, ConeHasItsTipUpAndSlopingSides) {
  const Mesh cone = makeCone(0.5, 2.0);
  const double volume = kPi * 0.25 * 2.0 / 3.0;
  EXPECT_NEAR(volumeOf(cone), volume, kFacets * volume);
  EXPECT_FLOAT_EQ(boundsOf(cone).max().z(), 1.0f);
  EXPECT_FLOAT_EQ(boundsOf(cone).min().z(), -1.0f);
  expectOutward(cone);
  // At right angles to the side, which leads 0.5 m out over 2 m down.
  const Eigen::Vector3f& normal = cone.normals[0];
  EXPECT_NEAR(normal.head<2>().norm() * 0.5f - normal.z() * 2.0f, 0.0f, 1e-6f);
}

TEST(Primitives, CapsuleIsACylinderBetweenHalfSpheres) {
  const Mesh capsule = makeCapsule(0.5, 2.0);
  const double volume = kPi * 0.25 * 2.0 + 4.0 / 3.0 * kPi * 0.125;
  EXPECT_NEAR(volumeOf(capsule), volume, kFacets * volume);
  EXPECT_FLOAT_EQ(boundsOf(capsule).max().z(), 1.5f);
  expectOutward(capsule);
}

TEST(Primitives, PlaneFacesItsNormal) {
  for (const Eigen::Vector3d& normal :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(3, 0, 4)}) {
    const Mesh plane = makePlane({2.0, 3.0}, normal);
    EXPECT_NEAR(areaOf(plane), 6.0, 6.0 * kFloat);
    EXPECT_NEAR(faceVector(plane, plane.triangles[0]).normalized().dot(normal.normalized()), 1.0, kFloat);
    expectOutward(plane);
  }
}

}  // namespace
}  // namespace sunlit::scene
