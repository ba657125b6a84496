#include "sunlit/evaluate/posed_view.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/message_of.h"
#include "support/textured_scene.h"

namespace sunlit::evaluate {
namespace {

const image::PinholeCamera kCamera = image::PinholeCamera::fromFieldOfView(64, 48, Angle::degrees(60));

/// 1/z = a + b x + c y of a plane.
cv::Mat planeDepth(double a, double b, double c) {
  cv::Mat depth(48, 64, CV_32FC1);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x)
      depth.at<float>(y, x) = static_cast<float>(1.0 / (a + b * x + c * y));
  }
  return depth;
}

TEST(DepthAt, IsExactBetweenThePixelsOfAPlane) {
  // A road seen from 1 m: one row of pixels to the next its depth falls by a third at the horizon.
  const cv::Mat depth = planeDepth(0.002, 0.0, 0.001);
  for (const Eigen::Vector2d& pixel :
       {Eigen::Vector2d(10.25, 1.5), {0.0, 0.75}, {62.5, 46.9}, {31.0, 20.0}}) {
    const auto found = depthAt(depth, pixel);
    ASSERT_TRUE(found);
    const double expected = 1.0 / (0.002 + 0.001 * pixel.y());
    EXPECT_NEAR(*found / expected, 1.0, 1e-6);  // 24 bits of a float, four of them
  }
}

TEST(DepthAt, MakesNothingUpBetweenTwoSurfaces) {
  cv::Mat depth(48, 64, CV_32FC1, cv::Scalar(20.0));
  depth.colRange(30, 64).setTo(5.0);
  EXPECT_EQ(depthAt(depth, {29.4, 10.0}), 20.0);
  EXPECT_EQ(depthAt(depth, {29.6, 10.0}), 5.0);
  depth.rowRange(20, 48).setTo(2.0);
  EXPECT_EQ(depthAt(depth, {29.6, 19.4}), 5.0);
  EXPECT_EQ(depthAt(depth, {29.6, 19.6}), 2.0);
}

TEST(DepthAt, EndsAtTheEdgesAndWhereNothingIsSeen) {
  cv::Mat depth(48, 64, CV_32FC1, cv::Scalar(3.0));
  EXPECT_EQ(depthAt(depth, {-0.5, -0.5}), 3.0);
  EXPECT_EQ(depthAt(depth, {63.4, 47.4}), 3.0);
  EXPECT_FALSE(depthAt(depth, {-0.6, 0.0}));
  EXPECT_FALSE(depthAt(depth, {63.5, 0.0}));
  EXPECT_FALSE(depthAt(depth, {0.0, 47.5}));
  EXPECT_FALSE(depthAt(depth, {std::numeric_limits<double>::quiet_NaN(), 0.0}));
  for (const float nothing :
       {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    depth.at<float>(10, 10) = nothing;
    EXPECT_FALSE(depthAt(depth, {10.3, 9.8}));
    EXPECT_EQ(depthAt(depth, {10.7, 9.8}), 3.0);  // the nearest pixel is seen
  }
  EXPECT_FALSE(depthAt(cv::Mat(), {0.0, 0.0}));
}

TEST(PointAt, IsWhereTheRayMeetsTheScene) {
  const PosedView view = corridor().seenFrom(lookingAlongX({1.0, 0.5, 0.0}), kCamera);
  // The ray through the middle meets the board at x = 4.
  const auto point = pointAt(view, {31.5, 23.5});
  ASSERT_TRUE(point);
  EXPECT_NEAR((*point - Eigen::Vector3d(4.0, 0.5, 0.0)).norm(), 0.0, 1e-6);
  // 30 degrees to the left, where the half pixel beyond the picture would be: (12 - 1) tan(30°) > 2.5.
  const auto left = pointAt(view, {-0.5, 23.5});
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->y(), 3.0, 0.05);  // the nearest pixel's depth: a pixel of 64 is 1 % there
}

TEST(RequireWhole, NamesWhatDoesNotFit) {
  PosedView view = corridor().seenFrom(lookingAlongX({0, 0, 0}), kCamera);
  EXPECT_EQ(messageOf([&] { requireWhole(view); }), "");
  view.depth = cv::Mat(24, 32, CV_32FC1, cv::Scalar(1.0));
  EXPECT_EQ(messageOf([&] { requireWhole(view); }), "depth is 32x24 px, but must be 64x48 px as its camera");
  view.depth = cv::Mat(48, 64, CV_64FC1, cv::Scalar(1.0));
  EXPECT_EQ(messageOf([&] { requireWhole(view); }), "depth must be of 32-bit floats");
  view.depth = cv::Mat();
  EXPECT_EQ(messageOf([&] { requireWhole(view); }), "");
  view.camera.width = 65;
  EXPECT_EQ(messageOf([&] { requireWhole(view); }),
            "the picture is 64x48 px, but must be 65x48 px as its camera");
}

}  // namespace
}  // namespace sunlit::evaluate
