#include "sunlit/evaluate/places/thumbnails.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "support/message_of.h"

namespace sunlit::evaluate {
namespace {

constexpr double kStepsPerSigma = 4096.0;
constexpr double kHalfAStep = 0.5 / kStepsPerSigma;

double valueAt(const Thumbnail& thumbnail, int x, int y) {
  return thumbnail.values.at<std::int16_t>(y, x) / kStepsPerSigma;
}

cv::Mat noise(int width, int height, std::uint64_t seed) {
  cv::RNG generator(seed);
  cv::Mat picture(height, width, CV_8UC1);
  generator.fill(picture, cv::RNG::UNIFORM, 0, 256);
  return picture;
}

TEST(Thumbnail, TakesEachPatchToMeanZeroAndSigmaOne) {
  // One patch half 100 and half 120, so that x − μ is ±10 and σ² = 64 · 100 / 63; another one of one bright
  // pixel of 64, the most that a patch can have: (n − 1)/√n = 7.875 there and −0.125 elsewhere.
  cv::Mat grey(kThumbnailHeight, kThumbnailWidth, CV_8UC1, cv::Scalar(100));
  grey(cv::Rect(0, 0, 4, 8)).setTo(120);
  grey.at<std::uint8_t>(9, 10) = 255;
  const Thumbnail thumbnail = makeThumbnail(grey);
  EXPECT_NEAR(valueAt(thumbnail, 0, 0), std::sqrt(63.0 / 64.0), kHalfAStep);
  EXPECT_NEAR(valueAt(thumbnail, 7, 7), -std::sqrt(63.0 / 64.0), kHalfAStep);
  EXPECT_EQ(valueAt(thumbnail, 10, 9), 7.875);
  EXPECT_EQ(valueAt(thumbnail, 11, 9), -0.125);
  EXPECT_EQ(valueAt(thumbnail, 63, 31), 0.0);  // a constant patch
  EXPECT_EQ(thumbnail.constant_patches, 32 - 2);
}

TEST(Thumbnail, DoesNotChangeWithBrightnessAndContrast) {
  cv::Mat grey = noise(kThumbnailWidth, kThumbnailHeight, 1);
  grey /= 4;
  const Thumbnail one = makeThumbnail(grey), other = makeThumbnail(grey * 3 + 20);
  EXPECT_EQ(cv::norm(one.values, other.values, cv::NORM_INF), 0.0);
}

TEST(Thumbnail, IsTheMeanOfWhatItsPixelsCover) {
  const cv::Mat small = noise(kThumbnailWidth, kThumbnailHeight, 2);
  cv::Mat large;
  cv::resize(small, large, {10 * kThumbnailWidth, 15 * kThumbnailHeight}, 0, 0, cv::INTER_NEAREST);
  EXPECT_EQ(cv::norm(makeThumbnail(large).values, makeThumbnail(small).values, cv::NORM_INF), 0.0);
}

TEST(Thumbnail, KeepsTheContrastsOfADarkPicture) {
  // Pixels of 0 and 1 only, 128 to each of the thumbnail's: as many of 1 as the other has levels.
  cv::Mat levels = noise(kThumbnailWidth, kThumbnailHeight, 4);
  levels /= 2;
  cv::Mat dark(16 * kThumbnailHeight, 8 * kThumbnailWidth, CV_8UC1);
  for (int y = 0; y < dark.rows; ++y)
    for (int x = 0; x < dark.cols; ++x)
      dark.at<std::uint8_t>(y, x) = y % 16 * 8 + x % 8 < levels.at<std::uint8_t>(y / 16, x / 8) ? 1 : 0;
  const Thumbnail thumbnail = makeThumbnail(dark);
  EXPECT_EQ(cv::norm(thumbnail.values, makeThumbnail(levels).values, cv::NORM_INF), 0.0);
  EXPECT_EQ(thumbnail.constant_patches, 0);
}

TEST(Thumbnail, CoversPartsOfPixels) {
  const cv::Mat grey = noise(150, 77, 5);  // 2.34 by 2.41 to one of the thumbnail
  cv::Mat as_float, small;
  grey.convertTo(as_float, CV_32F);
  cv::resize(as_float, small, {kThumbnailWidth, kThumbnailHeight}, 0, 0, cv::INTER_AREA);
  const Thumbnail thumbnail = makeThumbnail(grey);
  for (int y = 0; y < kThumbnailHeight; ++y) {
    for (int x = 0; x < kThumbnailWidth; ++x) {
      const cv::Mat patch = small(cv::Rect(x / 8 * 8, y / 8 * 8, 8, 8));
      cv::Scalar mean, sigma;
      cv::meanStdDev(patch, mean, sigma);
      const double expected = (small.at<float>(y, x) - mean[0]) / (sigma[0] * std::sqrt(64.0 / 63.0));
      ASSERT_NEAR(valueAt(thumbnail, x, y), expected, kHalfAStep + 1e-5) << x << ", " << y;
    }
  }
}

TEST(Thumbnail, IsMadeOfAPictureSmallerThanItToo) {
  EXPECT_EQ(makeThumbnail(noise(5, 3, 3)).values.size(), cv::Size(kThumbnailWidth, kThumbnailHeight));
}

TEST(Thumbnail, RefusesWhatIsNotGrey) {
  const std::string said = "a grey picture of 8 bit";
  EXPECT_NE(messageOf([] { makeThumbnail({}); }).find(said), std::string::npos);
  EXPECT_NE(messageOf([] { makeThumbnail(cv::Mat(4, 4, CV_8UC3)); }).find(said), std::string::npos);
}

TEST(ThumbnailDifferences, AreMeansOfAbsoluteDifferences) {
  cv::Mat left(kThumbnailHeight, kThumbnailWidth, CV_8UC1, cv::Scalar(100));
  cv::Mat right = left.clone();
  left.at<std::uint8_t>(0, 0) = 255;   // 7.875 and 63 times −0.125
  right.at<std::uint8_t>(7, 7) = 255;  // of the same patch: they differ by 8 in two pixels
  const PlaceMatrix differences =
      thumbnailDifferences({makeThumbnail(left), makeThumbnail(right)}, {makeThumbnail(left)});
  ASSERT_EQ(differences.rows(), 2);
  ASSERT_EQ(differences.cols(), 1);
  EXPECT_EQ(differences(0, 0), 0.0);
  EXPECT_EQ(differences(1, 0), 2.0 * 8.0 / (64.0 * 32.0));
}

TEST(ThumbnailDifferences, DoNotDependOnTheNumberOfThreads) {
  std::vector<Thumbnail> thumbnails;
  for (std::uint64_t seed = 0; seed < 20; ++seed) thumbnails.push_back(makeThumbnail(noise(90, 70, seed)));
  const PlaceMatrix many = thumbnailDifferences(thumbnails, thumbnails);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_TRUE((thumbnailDifferences(thumbnails, thumbnails).array() == many.array()).all());
  EXPECT_GT(many(0, 1), 0.5);
}

}  // namespace
}  // namespace sunlit::evaluate
