#include <gtest/gtest.h>

#include <algorithm>

#include "sunlit/evaluate/features/detector.h"
#include "sunlit/evaluate/features/matching.h"
#include "sunlit/evaluate/localise/map.h"
#include "sunlit/quantity/angle.h"
#include "support/textured_scene.h"

namespace sunlit::evaluate {
namespace {

const image::PinholeCamera kCamera{320, 240, 277.0, 277.0, 159.5, 119.5};

TEST(KeyFrame, KnowsWhereItsFeaturesAreAndLeavesOutTheSky) {
  PosedView view = corridor().seenFrom(lookingAlongX({0, 0, 0}), kCamera);
  view.depth.rowRange(0, 80).setTo(0.0F);  // as if that were sky
  const Features features = detectFeatures(*makeDetector("sift"), view.picture);
  const KeyFrame frame = keyFrameOf(view, features);
  std::size_t below = 0;
  for (const cv::KeyPoint& key_point : features.key_points) {
    if (key_point.pt.y >= 79.5F) ++below;
  }
  ASSERT_EQ(frame.points.size(), below);
  ASSERT_LT(below, features.key_points.size());
  ASSERT_EQ(static_cast<std::size_t>(frame.descriptors.rows), below);
  std::size_t in_corners = 0;
  for (const Eigen::Vector3d& point : frame.points) {
    // Of the walls, the floor or the board.
    const double off = std::min({std::abs(point.x() - 12), std::abs(std::abs(point.y()) - 3),
                                 std::abs(point.z() + 1), std::abs(point.x() - 4)});
    // Where two of them meet, what lies between pixels cuts the corner by less than a pixel: 12 m / 277.
    EXPECT_LT(off, 0.043) << point.transpose();
    if (off > 1e-5) ++in_corners;
  }
  EXPECT_LT(in_corners, frame.points.size() / 20);
  EXPECT_EQ(bytesOf(frame), below * (3 * 8 + 128));  // SIFT's 128 numbers are bytes
}

TEST(KeyFrame, LeavesOutWhatIsTooFarFromTheAxisOfALens) {
  const ViewCamera fisheye({320, 320, 100.0, 100.0, 159.5, 159.5},
                           {image::LensModel::kEquidistant, {0, 0, 0, 0}});
  ASSERT_NE(fisheye.lens, nullptr);
  const PosedView view = corridor().seenFrom(lookingAlongX({0, 0, 0}), fisheye);
  const Features features = detectFeatures(*makeDetector("sift"), view.picture);
  std::size_t straight = 0, others = 0;  // with a place
  for (const cv::KeyPoint& key_point : features.key_points) {
    if (!pointAt(view, {key_point.pt.x, key_point.pt.y})) continue;
    const double off = std::hypot(key_point.pt.x - 159.5, key_point.pt.y - 159.5);
    ++(off <= 100.0 * kStraightWithin_deg * kRadPerDeg ? straight : others);  // r = f θ
  }
  ASSERT_GT(others, 0u);
  EXPECT_EQ(keyFrameOf(view, features).points.size(), straight);
}

TEST(KeyFrame, CompactDescriptorsAreAsFarApartAsBefore) {
  const PosedView a = corridor().seenFrom(lookingAlongX({0, 0, 0}), kCamera);
  const PosedView b = corridor().seenFrom(lookingAlongX({0.3, 0.1, 0}), kCamera);
  const auto sift = makeDetector("sift");
  const cv::Mat of_a = detectFeatures(*sift, a.picture).descriptors;
  const cv::Mat of_b = detectFeatures(*sift, b.picture).descriptors;
  EXPECT_EQ(compactDescriptors(of_a).type(), CV_8UC1);
  const BothWays floats = twoNearestBothWays(of_a, of_b, cv::NORM_L2);
  const BothWays bytes = twoNearestBothWays(compactDescriptors(of_a), compactDescriptors(of_b), cv::NORM_L2);
  ASSERT_EQ(floats.from_a.size(), bytes.from_a.size());
  for (std::size_t i = 0; i < floats.from_a.size(); ++i) {
    EXPECT_EQ(floats.from_a[i].best, bytes.from_a[i].best);
    EXPECT_EQ(floats.from_a[i].best_distance, bytes.from_a[i].best_distance);
    EXPECT_EQ(floats.from_a[i].second_distance, bytes.from_a[i].second_distance);
  }
  const cv::Mat fractions(3, 4, CV_32FC1, cv::Scalar(0.5));
  EXPECT_EQ(compactDescriptors(fractions).type(), CV_32FC1);
  const cv::Mat large(3, 4, CV_32FC1, cv::Scalar(256.0));
  EXPECT_EQ(compactDescriptors(large).type(), CV_32FC1);
}

std::size_t taken(double spacing_m, double step_m, int steps) {
  KeyFrameSpacing spacing(spacing_m);
  std::size_t count = 0;
  for (int i = 0; i <= steps; ++i) count += spacing.takes({0.0, i * step_m, 0.0});
  return count;
}

TEST(KeyFrameSpacing, TakesOnePoseOfSoManyMetres) {
  EXPECT_EQ(taken(5.0, 1.0, 100), 21u);  // at 0, 5, … 100 m
  EXPECT_EQ(taken(0.5, 0.1, 100), 21u);  // whatever 0.1 is in binary
  EXPECT_EQ(taken(5.0, 3.0, 20), 11u);   // at 0, 6, … 60 m
  EXPECT_EQ(taken(0.0, 1.0, 10), 11u);   // all
  EXPECT_EQ(taken(5.0, 0.0, 10), 1u);    // a camera that stands still
}

}  // namespace
}  // namespace sunlit::evaluate
