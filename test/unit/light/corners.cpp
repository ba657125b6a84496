#include "light/geometry/corners.h"

#include <gtest/gtest.h>

#include "paper_scene.h"

namespace sunlit::light {
namespace {

/// Of one strip, 100 m long and turned out of all axes.
Geometry strip(float height_m) {
  scene::Scene scene;
  scene.materials = {paint(0.5f)};
  const Eigen::Vector3f along = 100.0f * Eigen::Vector3f(2.0f, 1.0f, 0.5f).normalized();
  addPatch(&scene, 0, {31.0f, -47.0f, 3.0f}, along,
           height_m * along.cross(Eigen::Vector3f::UnitZ()).normalized());
  return Geometry(std::make_shared<const scene::Scene>(std::move(scene)));
}

TEST(Corners, ALongThinTriangleKnowsWhereItsPointsAre) {
  for (const float height_m : {0.15f, 0.05f}) {
    const Geometry geometry = strip(height_m);
    for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
      const Corners corners(geometry, t);
      const auto corner = [&](std::size_t k) { return geometry.positions[geometry.triangles[t][k]]; };
      for (const float v : {0.02f, 0.3f, 0.55f, 0.9f}) {
        const std::array<float, 3> shares = {0.6f * (1.0f - v), v, 0.4f * (1.0f - v)};
        const Eigen::Vector3f point = shares[0] * corner(0) + shares[1] * corner(1) + shares[2] * corner(2);
        const std::array<float, 3> found = corners.within(point);
        const Eigen::Vector3f back = found[0] * corner(0) + found[1] * corner(1) + found[2] * corner(2);
        // The point itself is rounded to 4 µm, 1e-4 of the smaller height, and so are its shares: 1e-4 of 100
        // m. With the products in single precision it came out up to 50 m off.
        EXPECT_LT((back - point).norm(), 0.02f) << height_m << " m high, triangle " << t << ", share " << v;
      }
    }
  }
}

}  // namespace
}  // namespace sunlit::light
