#include "sunlit/image/camera.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sunlit::image {
namespace {

TEST(PinholeCamera, TheFieldOfViewSpansTheImageEdgeToEdge) {
  const PinholeCamera camera = PinholeCamera::fromFieldOfView(640, 480, Angle::degrees(90.0));
  // Pixel centres are whole numbers, so the left edge of the image is at −0.5 and is seen at 45°.
  EXPECT_NEAR(camera.unproject({-0.5, 239.5}).x(), -1.0, 1e-12);  // rounding only
  EXPECT_NEAR(camera.unproject({639.5, 239.5}).x(), 1.0, 1e-12);
  EXPECT_EQ(camera.fx, camera.fy);
}

TEST(PinholeCamera, HasEveryFieldOfViewThatMayBeAskedForInPicturesOfUsualWidth) {
  double fov_deg = 0.0;
  const Range range = fieldOfViewRow(&fov_deg).range;
  for (const int width : {16, 640, 1600}) {
    for (const double deg : {range.low, range.high}) {
      const PinholeCamera camera = PinholeCamera::fromFieldOfView(width, width, Angle::degrees(deg));
      EXPECT_NO_THROW(requireFields(camera)) << deg << " deg of " << width << " px";
      // Twice the angle whose tangent is half the width over the focal length.
      EXPECT_NEAR(2.0 * std::atan2(0.5 * width, camera.fx), deg * kRadPerDeg, 1e-12);  // rounding only
    }
  }
}

TEST(PinholeCamera, ProjectUndoesUnproject) {
  PinholeCamera camera = PinholeCamera::fromFieldOfView(640, 480, Angle::degrees(80.0));
  camera.fy = 400.0;
  camera.cx = 300.25;
  const Eigen::Vector2d pixel(123.5, 456.75);
  EXPECT_NEAR((camera.project(7.0 * camera.unproject(pixel)) - pixel).norm(), 0.0, 1e-10);  // rounding only
}

TEST(PinholeCamera, RightIsRightAndDownIsDown) {
  const PinholeCamera camera = PinholeCamera::fromFieldOfView(640, 480, Angle::degrees(80.0));
  const Eigen::Vector2d pixel = camera.project({1.0, 1.0, 5.0});
  EXPECT_GT(pixel.x(), camera.cx);
  EXPECT_GT(pixel.y(), camera.cy);
}

}  // namespace
}  // namespace sunlit::image
