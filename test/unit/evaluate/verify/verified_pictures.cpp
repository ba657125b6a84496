// From pictures to measures, by real detectors.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <opencv2/imgproc.hpp>

#include "sunlit/evaluate/verify/verify.h"
#include "support/message_of.h"
#include "unit/evaluate/features/surf_picture.h"

namespace sunlit::evaluate {
namespace {

cv::Mat rgbOf(const cv::Mat& grey) {
  cv::Mat rgb;
  cv::cvtColor(grey, rgb, cv::COLOR_GRAY2RGB);
  return rgb;
}

const cv::Mat kPicture = rgbOf(test::madePicture(400, 300));

TEST(VerifiedPictures, AreFoundAgainWholeInThemselves) {
  const auto verified = verifyImages({kPicture, kPicture}, identityMaps({400, 300}), {});
  ASSERT_EQ(verified.size(), paperDetectors().size());
  for (std::size_t d = 0; d < verified.size(); ++d) {
    SCOPED_TRACE(paperDetectors()[d]);
    const Verified& v = verified[d];
    ASSERT_GT(v.difference.features_a, 100u);
    EXPECT_EQ(v.common_a, v.difference.features_a);
    EXPECT_EQ(v.correspondences, v.difference.features_a);
    EXPECT_EQ(v.repeatability, 1.0);
    EXPECT_EQ(v.matching_accuracy[0], 1.0);
    EXPECT_EQ(v.precision, 1.0);
    EXPECT_EQ(v.difference.matches + v.difference.zero_second, v.difference.features_a);  // all but twins
    EXPECT_EQ(v.matching_score,
              static_cast<double>(v.mutual_matches) / static_cast<double>(v.difference.features_a));
  }
}

TEST(VerifiedPictures, AreFoundAgainWholeWhereTheyAreMovedByWholePixels) {
  // Windows of one picture, 7 px and 5 px apart. ORB and SIFT work on smaller and larger copies, whose pixels
  // lie elsewhere; so only SURF and BRISK at its finest could be exact, and most of all must be right.
  const cv::Mat b = kPicture(cv::Rect(7, 5, 393, 295));
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(0, 2) = -7.0;
  matrix(1, 2) = -5.0;
  const PointMaps right = homographyMaps(matrix, {{400, 300}, {393, 295}});
  const PointMaps wrong = homographyMaps(Eigen::Matrix3d::Identity(), {{400, 300}, {393, 295}});
  const auto verified = verifyImages({kPicture, b}, right, {});
  const auto unmoved = verifyImages({kPicture, b}, wrong, {});
  for (std::size_t d = 0; d < verified.size(); ++d) {
    SCOPED_TRACE(paperDetectors()[d]);
    EXPECT_GT(verified[d].precision, 0.95);
    EXPECT_GT(verified[d].matching_accuracy[2], 0.8);
    EXPECT_GT(verified[d].repeatability, 0.7);
    EXPECT_LT(unmoved[d].precision, 0.05);  // 8.6 px off
    EXPECT_EQ(unmoved[d].difference.value, verified[d].difference.value);
  }
}

TEST(VerifiedPictures, GiveTheSameBitsForAnyNumberOfThreads) {
  cv::Mat darker;
  kPicture.convertTo(darker, CV_8U, 0.85, 7.0);
  const PointMaps maps = identityMaps({400, 300});
  const auto expected = verifyImages({kPicture, darker}, maps, {});
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  cv::setNumThreads(1);
  const auto alone = verifyImages({kPicture, darker}, maps, {});
  cv::setNumThreads(-1);
  ASSERT_EQ(alone.size(), expected.size());
  for (std::size_t d = 0; d < alone.size(); ++d) {
    SCOPED_TRACE(paperDetectors()[d]);
    EXPECT_GT(expected[d].mutual_matches, 50u);
    EXPECT_EQ(alone[d].repeatability, expected[d].repeatability);
    EXPECT_EQ(alone[d].matching_score, expected[d].matching_score);
    EXPECT_EQ(alone[d].matching_accuracy, expected[d].matching_accuracy);
    EXPECT_EQ(alone[d].mutual_matches, expected[d].mutual_matches);
    EXPECT_EQ(alone[d].precision, expected[d].precision);
    EXPECT_EQ(alone[d].recall, expected[d].recall);
    EXPECT_EQ(alone[d].average_precision, expected[d].average_precision);
    EXPECT_EQ(alone[d].difference.value, expected[d].difference.value);
  }
}

TEST(VerifiedPictures, RefuseOptionsOutOfRange) {
  const auto refusalOf = [](const VerifyOptions& options) {
    return messageOf([&] { verifyImages({kPicture, kPicture}, identityMaps({400, 300}), options); });
  };
  VerifyOptions options;
  options.ratio_test.ratio = 0.0;
  EXPECT_EQ(refusalOf(options).rfind("ratio is 0, but must be", 0), 0u);
  options = {};
  for (const Field& row : options.known.fieldsOf({"orb"})) {
    if (row.key == "features/orb/n_features") *std::get<int*>(row.place) = 0;
  }
  EXPECT_EQ(refusalOf(options).rfind("features/orb/n_features is 0", 0), 0u);
  options = {};
  options.detectors = {"boolean_rgb"};
  const std::string refusal = "detectors is [boolean_rgb], but must be a list of some of ";
#ifdef SUNLIT_SIFT
  EXPECT_EQ(refusalOf(options).rfind(refusal + "sift", 0), 0u);
#else
  EXPECT_EQ(refusalOf(options).rfind(refusal, 0), 0u);
#endif
}

}  // namespace
}  // namespace sunlit::evaluate
