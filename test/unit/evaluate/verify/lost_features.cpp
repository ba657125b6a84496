#include "sunlit/evaluate/verify/lost_features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace sunlit::evaluate {
namespace {

/// Each with a descriptor of its own.
Features featuresAt(const std::vector<cv::Point2f>& points) {
  Features features;
  features.descriptors = cv::Mat(static_cast<int>(points.size()), 1, CV_32F);
  for (std::size_t i = 0; i < points.size(); ++i) {
    features.key_points.emplace_back(points[i], 1.0F);
    features.descriptors.at<float>(static_cast<int>(i)) = 100.0F * static_cast<float>(i);
  }
  return features;
}

// Of 32 x 24 px, so that cells are 2 px wide, and the first begins at -0.5.
constexpr PictureSize kSize{32, 24};

LostFeatures lostOf(const Features& a, const Features& b, const PointMaps& maps) {
  const BothWays nearest = twoNearestBothWays(a.descriptors, b.descriptors, cv::NORM_L2);
  return lostFeatures({a, b, nearest}, acceptedMatches({a, b, nearest}, maps, {}), maps, kSize);
}

TEST(LostFeatures, AreThoseWithoutARightMatchWhereTheyStand) {
  const Features a = featuresAt({{0, 0}, {1.4F, 1.4F}, {1.6F, 0}, {31, 23}});
  // Right, 2 px off and right, 10 px off, and 4 px off.
  const Features b = featuresAt({{0, 0}, {3.4F, 1.4F}, {11.6F, 0}, {31, 19}});
  const LostFeatures found = lostOf(a, b, identityMaps(kSize));
  LostFeatures expected;
  expected.features[0] = 2;
  expected.features[1] = expected.lost[1] = 1;
  expected.features[16 * 12 - 1] = expected.lost[16 * 12 - 1] = 1;
  EXPECT_EQ(found.features, expected.features);
  EXPECT_EQ(found.lost, expected.lost);
}

TEST(LostFeatures, DoNotCountWhatTheOtherPictureDoesNotShow) {
  const Features a = featuresAt({{5, 5}, {25, 5}});
  const Features b = featuresAt({{90, 90}, {90, 95}});
  PointMaps maps = identityMaps(kSize);
  maps.b_from_a = [](const Eigen::Vector2d& place) {
    return place.x() < 16 ? std::optional<Eigen::Vector2d>(place) : std::nullopt;  // hidden on the right
  };
  const LostFeatures found = lostOf(a, b, maps);
  EXPECT_EQ(std::accumulate(found.features.begin(), found.features.end(), 0), 1);
  EXPECT_EQ(found.lost, found.features);
  EXPECT_EQ(found.lost[2 * 16 + 2], 1);
}

LostFeatures inCell(std::size_t cell, std::uint16_t features, std::uint16_t lost) {
  LostFeatures one;
  one.features[cell] = features;
  one.lost[cell] = lost;
  return one;
}

TEST(LostFeatures, AreSummedOverWhatCountsOnce) {
  const TemporaryFolder folder;
  const FramesLayout layout{{{"h04", "h12"}, {"h04", "h20"}}, {"sift", "orb"}};
  const std::string head = lostFileHeader() + "\n";
  setContent(folder.file("a"),
             head + lostRecordOf(1, 0, 1, inCell(17, 5, 3)) +
                 lostRecordOf(1, 0, 1, inCell(17, 5, 3)) +  // twice, as a kill may leave it
                 lostRecordOf(9, 0, 1, inCell(17, 5, 3)));  // of a stamp that does not count
  setContent(folder.file("b"), head + lostRecordOf(2, 0, 1, inCell(17, 40000, 40000)) +
                                   lostRecordOf(3, 0, 1, inCell(17, 40000, 4)) +
                                   lostRecordOf(3, 0, 1, {}).substr(0, 100));
  EXPECT_EQ(mendLostFile(folder.file("b")), 100u);
  EXPECT_EQ(mendLostFile(folder.file("b")), 0u);
  EXPECT_EQ(mendLostFile(folder.file("none")), 0u);
  const auto sums = sumsOfLost({folder.file("a"), folder.file("b"), folder.file("none")}, layout,
                               [](std::int64_t stamp_ns, std::size_t) { return stamp_ns != 9; });
  ASSERT_EQ(sums.size(), 4u);
  EXPECT_EQ(sums[1].poses, 3u);
  EXPECT_EQ(sums[1].features[17], 80005u);
  EXPECT_EQ(sums[1].lost[17], 40007u);
  EXPECT_EQ(sums[0].poses + sums[2].poses + sums[3].poses, 0u);
  writeLost(folder.file("lost.csv"), layout, sums);
  const std::string text = contentOf(folder.file("lost.csv"));
  EXPECT_NE(text.find("\nh04,h12,orb,3,1,1,80005,40007\n"), std::string::npos) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 16 * 12);
}

TEST(LostFeatures, OfAnotherKindOfFileAreRefused) {
  const TemporaryFolder folder;
  setContent(folder.file("x"), "something else that is long enough\n");
  EXPECT_NE(
      messageOf<std::runtime_error>([&] { mendLostFile(folder.file("x")); }).find("x: is not a file of lost"),
      std::string::npos);
}

}  // namespace
}  // namespace sunlit::evaluate
