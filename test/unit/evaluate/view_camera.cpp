// Key points of a lens go where OpenCV's own functions undistort them to, and depth meets through lenses.
#include "sunlit/evaluate/view_camera.h"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include "support/published_lenses.h"
#include "support/textured_scene.h"

namespace sunlit::evaluate {
namespace {

/// Key points all over a picture; each descriptor holds its number.
Features grid(const image::PinholeCamera& camera) {
  Features features;
  for (int y = 8; y < camera.height; y += 24) {
    for (int x = 8; x < camera.width; x += 24) {
      features.descriptors.push_back(
          cv::Mat(cv::Matx<float, 1, 1>(static_cast<float>(features.key_points.size()))));
      features.key_points.emplace_back(static_cast<float>(x), static_cast<float>(y), 5.0f);
    }
  }
  return features;
}

TEST(ViewCamera, StraightensKeyPointsAsOpenCvDoes) {
  for (const PublishedLens& published : {eurocLens(), kittiLens(), tumLens(), tumViLens()}) {
    const ViewCamera camera(published.camera, published.distortion);
    const Features bent = grid(published.camera), straight = straightOnes(bent, camera).straight;
    const cv::Matx33d k(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
    ASSERT_GT(straight.key_points.size(), bent.key_points.size() / 2) << published.name;
    for (std::size_t i = 0; i < straight.key_points.size(); ++i) {
      const auto number = static_cast<std::size_t>(straight.descriptors.at<float>(static_cast<int>(i), 0));
      const std::vector<cv::Point2f> from = {bent.key_points[number].pt};
      std::vector<cv::Point2f> to;
      if (published.distortion.model == image::LensModel::kEquidistant) {
        cv::fisheye::undistortPoints(from, to, k, published.distortion.coefficients, cv::noArray(), k);
      } else {
        const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 200, 1e-9);
        cv::undistortPoints(from, to, k, published.distortion.coefficients, cv::noArray(), k, until);
      }
      // Theirs iterates to a fixed point in single precision, to 1e-3 px of some 1,000.
      EXPECT_NEAR(straight.key_points[i].pt.x, to[0].x, 0.01) << published.name;
      EXPECT_NEAR(straight.key_points[i].pt.y, to[0].y, 0.01) << published.name;
    }
  }
}

TEST(ViewCamera, LeavesOutWhatIsTooFarFromTheAxisAndKeepsAllOfAPinhole) {
  const ViewCamera fisheye(tumViLens().camera, tumViLens().distortion);
  for (const cv::KeyPoint& key_point : straightOnes(grid(fisheye), fisheye).seen.key_points) {
    const Eigen::Vector3d ray = fisheye.unproject({key_point.pt.x, key_point.pt.y}).value();
    EXPECT_LT(std::acos(ray.z()), (kStraightWithin_deg + 1e-6) * kRadPerDeg);
  }
  const ViewCamera pinhole(d435iLens().camera, d435iLens().distortion);
  EXPECT_EQ(pinhole.lens, nullptr);
  for (const Features& features :
       {straightOnes(grid(pinhole), pinhole).seen, straightOnes(grid(pinhole), pinhole).straight})
    EXPECT_EQ(features.key_points.size(), grid(pinhole).key_points.size());
}

// Two views of a wall: where depth says that a pixel's place is, the other camera sees it at the same depth.
TEST(ViewCamera, ViewsMeetThroughTheirLenses) {
  for (const image::Distortion& distortion :
       {image::Distortion{image::LensModel::kPlumbBob, {-0.283, 0.074, 2e-4, 2e-5}},
        image::Distortion{image::LensModel::kEquidistant, {0.0035, 0.0007, -0.002, 0.0002}}}) {
    const ViewCamera camera({160, 120, 90.0, 90.0, 79.0, 60.0}, distortion);
    const TexturedScene wall({{{10, 40, 40}, {0, -80, 0}, {0, 0, -80}, 1}});
    const PosedView a = wall.seenFrom(lookingAlongX({0, 0, 0}), camera);
    const PosedView b = wall.seenFrom(lookingAlongX({1.0, 0.7, -0.3}, 0.1), camera);
    int met = 0;
    for (const Eigen::Vector2d& pixel : {Eigen::Vector2d(80, 60), {50, 40}, {110.5, 90.25}, {60, 100}}) {
      const auto seen = pointAt(a, pixel);
      if (!seen) continue;
      const Eigen::Vector3d of_a = a.map_from_optical.linear() * camera.unproject(pixel).value();
      const Eigen::Vector3d place = a.map_from_optical.translation() + of_a * (10.0 / of_a.x());
      const Eigen::Vector3d of_b = b.map_from_optical.inverse() * *seen;
      const auto there = camera.project(of_b);
      const auto expected = camera.project(b.map_from_optical.inverse() * place);
      ASSERT_TRUE(there && expected);
      EXPECT_LT((*there - *expected).norm(), 0.02);  // depth is interpolated between pixels
      const auto shown = depthAt(b.depth, *there);
      if (!shown) continue;
      ++met;
      EXPECT_NEAR(*shown, camera.depthOf(of_b), 0.01 * *shown);
    }
    EXPECT_GE(met, 3);
  }
}

}  // namespace
}  // namespace sunlit::evaluate
