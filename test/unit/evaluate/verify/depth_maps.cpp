#include "sunlit/evaluate/verify/depth_maps.h"

#include <gtest/gtest.h>

#include "support/message_of.h"
#include "support/textured_scene.h"

namespace sunlit::evaluate {
namespace {

const image::PinholeCamera kCamera{100, 80, 100.0, 100.0, 49.5, 39.5};

/// Walls across the view, at 10 m and, in front of its middle, at 5 m; both 40 m wide and as high.
PosedView twoWalls(double y) {
  const TexturedScene scene(
      {{{10, 20, 20}, {0, -40, 0}, {0, 0, -40}, 1}, {{5, 1, 1}, {0, -2, 0}, {0, 0, -2}, 2}});
  return scene.seenFrom(lookingAlongX({0, y, 0}), kCamera);
}

TEST(DepthMaps, MoveNearThingsMoreThanFarOnes) {
  // b stands 1 m to the left of a: what lies 5 m off moves by 100/5 px to the right, what lies 10 m off
  // by 10.
  const PointMaps maps = depthMaps(twoWalls(0.0), twoWalls(1.0));
  const auto near = maps.b_from_a({45.0, 40.0});
  ASSERT_TRUE(near);
  EXPECT_NEAR((*near - Eigen::Vector2d(65.0, 40.0)).norm(), 0.0, 1e-5);  // of single precision
  const auto far = maps.b_from_a({80.0, 40.0});
  ASSERT_TRUE(far);
  EXPECT_NEAR((*far - Eigen::Vector2d(90.0, 40.0)).norm(), 0.0, 1e-5);
  const auto back = maps.a_from_b(*far);
  ASSERT_TRUE(back);
  EXPECT_NEAR((*back - Eigen::Vector2d(80.0, 40.0)).norm(), 0.0, 1e-5);
}

TEST(DepthMaps, ShowNothingThatTheOtherViewHides) {
  // In a the near wall covers x from 29.5 to 69.5 px, in b from 49.5 to 89.5. So of the far wall b hides what
  // a sees from 39.5 to 79.5 px, which a itself sees from 69.5 on.
  const PointMaps maps = depthMaps(twoWalls(0.0), twoWalls(1.0));
  EXPECT_TRUE(maps.b_from_a({25.0, 40.0}));
  for (const double x : {71.0, 75.0, 78.0}) EXPECT_FALSE(maps.b_from_a({x, 40.0})) << x;
  EXPECT_TRUE(maps.b_from_a({81.0, 40.0}));
  EXPECT_TRUE(maps.b_from_a({75.0, 10.0}));   // above the near wall
  EXPECT_FALSE(maps.b_from_a({95.0, 40.0}));  // 105: beyond the picture
}

TEST(DepthMaps, AgreeWithTheHomographyOfAPlane) {
  const TexturedScene wall({{{10, 20, 20}, {4, -40, 0}, {-3, 0, -40}, 1}});
  const PosedView a = wall.seenFrom(lookingAlongX({0, 0, 0}), kCamera);
  const PosedView b = wall.seenFrom(lookingAlongX({1.0, 0.7, -0.3}, 0.1), kCamera);
  // H = K (R + t nᵀ / d) K⁻¹ with b = R a + t and nᵀ x = d (Hartley & Zisserman, eq. 13.2).
  Eigen::Matrix3d k;
  k << kCamera.fx, 0, kCamera.cx, 0, kCamera.fy, kCamera.cy, 0, 0, 1;
  const Eigen::Isometry3d b_from_a = b.map_from_optical.inverse() * a.map_from_optical;
  const Eigen::Vector3d corner = a.map_from_optical.inverse() * Eigen::Vector3d(10, 20, 20);
  const Eigen::Vector3d normal = a.map_from_optical.linear().transpose() *
                                 Eigen::Vector3d(4, -40, 0).cross(Eigen::Vector3d(-3, 0, -40)).normalized();
  const Eigen::Matrix3d homography =
      k * (b_from_a.linear() + b_from_a.translation() * normal.transpose() / normal.dot(corner)) *
      k.inverse();
  const PointMaps by_depth = depthMaps(a, b);
  const PointMaps by_plane = homographyMaps(homography, {{100, 80}, {100, 80}});
  std::size_t common = 0;
  for (double y = 5.25; y < 75.0; y += 7.0) {
    for (double x = 5.5; x < 95.0; x += 9.0) {
      const auto one = by_depth.b_from_a({x, y});
      const auto other = by_plane.b_from_a({x, y});
      ASSERT_EQ(one.has_value(), other.has_value()) << x << " " << y;
      if (!one) continue;
      ++common;
      EXPECT_NEAR((*one - *other).norm(), 0.0, 1e-4);  // depth of 24 bits
    }
  }
  EXPECT_GT(common, 50u);
}

TEST(DepthMaps, KnowNothingWithoutDepth) {
  PosedView a = twoWalls(0.0);
  const PosedView b = twoWalls(1.0);
  a.depth.at<float>(40, 80) = 0.0F;
  EXPECT_FALSE(depthMaps(a, b).b_from_a({80.0, 40.0}));
  EXPECT_FALSE(depthMaps(a, b).a_from_b({90.0, 40.0}));
  a.depth = cv::Mat();
  EXPECT_EQ(messageOf([&] { depthMaps(a, b); }), "a view has no depth, but both must have");
}

}  // namespace
}  // namespace sunlit::evaluate
