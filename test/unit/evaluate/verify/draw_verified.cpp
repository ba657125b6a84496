#include "sunlit/evaluate/verify/draw_verified.h"

#include <gtest/gtest.h>

namespace sunlit::evaluate {
namespace {

Features featuresAt(const std::vector<cv::Point2f>& points) {
  Features features;
  features.descriptors = cv::Mat(static_cast<int>(points.size()), 1, CV_32F);
  for (std::size_t i = 0; i < points.size(); ++i) {
    features.key_points.emplace_back(points[i], 1.0F);
    features.descriptors.at<float>(static_cast<int>(i)) = 100.0F * static_cast<float>(i);
  }
  return features;
}

TEST(DrawVerified, ShowsRightMatchesGreenAndWrongOnesRed) {
  const cv::Mat black(60, 80, CV_8UC3, cv::Scalar::all(0));
  const Features a = featuresAt({{10, 10}, {10, 30}, {10, 50}});
  const Features b = featuresAt({{12, 10}, {10, 34}, {70, 10}});  // 2 px, 4 px and a world off
  const BothWays nearest = twoNearestBothWays(a.descriptors, b.descriptors, cv::NORM_L2);
  const FeaturePair features{a, b, nearest};
  const PointMaps same = identityMaps({80, 60});
  const std::vector<AcceptedMatch> accepted = acceptedMatches(features, same, {});
  ASSERT_EQ(accepted.size(), 3u);
  EXPECT_TRUE(accepted[0].is_right);
  EXPECT_FALSE(accepted[1].is_right);
  EXPECT_FALSE(accepted[2].is_right);
  const cv::Mat drawn = drawVerified({black, black}, features, accepted);
  ASSERT_EQ(drawn.size(), cv::Size(160, 60));
  // Half-way between (10, 10) and (92, 10), (10, 30) and (90, 34); lines may be smoothed.
  const auto strongest = [&](int x, int y) {
    cv::Vec3b most(0, 0, 0);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int c = 0; c < 3; ++c) most[c] = std::max(most[c], drawn.at<cv::Vec3b>(y + dy, x)[c]);
    }
    return most;
  };
  EXPECT_GT(strongest(51, 10)[1], 2 * strongest(51, 10)[0]);
  EXPECT_GT(strongest(30, 31)[0], 2 * strongest(30, 31)[1]);
  EXPECT_EQ(drawn.at<cv::Vec3b>(55, 80), cv::Vec3b(0, 0, 0));
}

TEST(DrawVerified, ShowsBothPicturesWhereNothingMatches) {
  const cv::Mat grey(60, 80, CV_8UC3, cv::Scalar::all(90));
  const Features none;
  const BothWays nearest;
  const cv::Mat drawn = drawVerified({grey, grey}, {none, none, nearest}, {});
  EXPECT_EQ(drawn.size(), cv::Size(160, 60));
  EXPECT_EQ(drawn.at<cv::Vec3b>(30, 120), cv::Vec3b(90, 90, 90));
}

}  // namespace
}  // namespace sunlit::evaluate
