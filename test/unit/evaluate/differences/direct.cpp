#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "sunlit/evaluate/differences/differences.h"

namespace sunlit::evaluate {
namespace {

struct DirectDifferences {
  double boolean_rgb = 0.0;
  double boolean_grey = 0.0;
  double euclidean_rgb = 0.0;
  double euclidean_grey = 0.0;
};

DirectDifferences directDifferences(const Picture& a, const Picture& b) {
  const Differences known;
  const Features none;
  const auto value = [&](const std::string& name) {
    const DifferenceValue found = known.at(name).between({a, none}, {b, none}, {BothWays{}, {}}, {});
    EXPECT_EQ(found.symmetric, found.value);
    EXPECT_EQ(found.one_to_one, found.value);
    return found.value;
  };
  return {value("boolean_rgb"), value("boolean_grey"), value("euclidean_rgb"), value("euclidean_grey")};
}

// The definition, pixel by pixel.
DirectDifferences slowly(const Picture& a, const Picture& b) {
  DirectDifferences result;
  for (int y = 0; y < a.rgb.rows; ++y) {
    for (int x = 0; x < a.rgb.cols; ++x) {
      const auto p = a.rgb.at<cv::Vec3b>(y, x);
      const auto q = b.rgb.at<cv::Vec3b>(y, x);
      const int grey = a.grey.at<uchar>(y, x) - b.grey.at<uchar>(y, x);
      result.boolean_rgb += p != q ? 1 : 0;
      result.boolean_grey += grey != 0 ? 1 : 0;
      result.euclidean_grey += grey * grey;
      for (int c = 0; c < 3; ++c) result.euclidean_rgb += (p[c] - q[c]) * (p[c] - q[c]);
    }
  }
  const double pixels = static_cast<double>(a.rgb.total());
  result.boolean_rgb /= pixels;
  result.boolean_grey /= pixels;
  result.euclidean_rgb /= 3.0 * 255.0 * 255.0 * pixels;
  result.euclidean_grey /= 255.0 * 255.0 * pixels;
  return result;
}

TEST(DirectDifferences, FollowFromPencilAndPaper) {
  cv::Mat a(1, 4, CV_8UC3, cv::Scalar(0, 0, 0));
  cv::Mat b = a.clone();
  b.at<cv::Vec3b>(0, 0) = {255, 255, 255};  // grey 255
  b.at<cv::Vec3b>(0, 1) = {0, 0, 1};        // grey 0.114, rounded 0: only rgb sees it
  b.at<cv::Vec3b>(0, 2) = {100, 100, 100};  // grey 100
  const DirectDifferences d = directDifferences(makePicture(a), makePicture(b));
  EXPECT_EQ(d.boolean_rgb, 3.0 / 4.0);
  EXPECT_EQ(d.boolean_grey, 2.0 / 4.0);
  // Sums of whole numbers and one division: only the order of the division may round otherwise.
  EXPECT_DOUBLE_EQ(d.euclidean_rgb, (3.0 * 65025 + 1 + 3.0 * 10000) / (3.0 * 65025 * 4));
  EXPECT_DOUBLE_EQ(d.euclidean_grey, (65025.0 + 10000) / (65025.0 * 4));
}

TEST(DirectDifferences, ReachOneForBlackAgainstWhite) {
  // 4200 columns: longer than one block of the fast loop, and its sums are the largest that there are.
  const Picture black = makePicture(cv::Mat(3, 4200, CV_8UC3, cv::Scalar(0, 0, 0)));
  const Picture white = makePicture(cv::Mat(3, 4200, CV_8UC3, cv::Scalar(255, 255, 255)));
  const DirectDifferences d = directDifferences(black, white);
  EXPECT_EQ(d.boolean_rgb, 1.0);
  EXPECT_EQ(d.boolean_grey, 1.0);
  EXPECT_EQ(d.euclidean_rgb, 1.0);
  EXPECT_EQ(d.euclidean_grey, 1.0);
}

TEST(DirectDifferences, AreThoseOfTheSlowLoopForAnyWidth) {
  cv::RNG generator(3);
  for (const int width : {1, 15, 16, 17, 33, 640, 4097}) {
    cv::Mat a(7, width, CV_8UC3);
    cv::Mat b(7, width, CV_8UC3);
    generator.fill(a, cv::RNG::UNIFORM, 0, 256);
    generator.fill(b, cv::RNG::UNIFORM, 0, 256);
    a.rowRange(0, 3).copyTo(b.rowRange(0, 3));
    const DirectDifferences fast = directDifferences(makePicture(a), makePicture(b));
    const DirectDifferences slow = slowly(makePicture(a), makePicture(b));
    EXPECT_EQ(fast.boolean_rgb, slow.boolean_rgb) << width;
    EXPECT_EQ(fast.boolean_grey, slow.boolean_grey) << width;
    EXPECT_DOUBLE_EQ(fast.euclidean_rgb, slow.euclidean_rgb) << width;
    EXPECT_DOUBLE_EQ(fast.euclidean_grey, slow.euclidean_grey) << width;
  }
}

TEST(DirectDifferences, AreZeroForAnImageAgainstItself) {
  cv::Mat a(48, 64, CV_8UC3);
  cv::RNG(5).fill(a, cv::RNG::UNIFORM, 0, 256);
  const DirectDifferences d = directDifferences(makePicture(a), makePicture(a.clone()));
  EXPECT_EQ(d.boolean_rgb + d.boolean_grey + d.euclidean_rgb + d.euclidean_grey, 0.0);
}

TEST(DirectDifferences, RefuseOtherSizesAndTypes) {
  const Picture a = makePicture(cv::Mat(4, 4, CV_8UC3, cv::Scalar::all(0)));
  EXPECT_THROW(directDifferences(a, makePicture(cv::Mat(4, 5, CV_8UC3, cv::Scalar::all(0)))),
               std::invalid_argument);
  EXPECT_THROW(makePicture(cv::Mat(4, 4, CV_8UC1, cv::Scalar::all(0))), std::invalid_argument);
  EXPECT_THROW(makePicture(cv::Mat()), std::invalid_argument);
}

TEST(DirectDifferences, OfTheLeuvenPhotographsAreThePublishedOnes) {
  const std::string folder = std::string(SUNLIT_SHARED_DIR) + "/data/leuven/";
  const auto load = [&](int i) {
    cv::Mat image = cv::imread(folder + "img" + std::to_string(i) + ".ppm");
    if (!image.empty()) cv::cvtColor(image, image, cv::COLOR_BGR2RGB);
    return image;
  };
  if (load(1).empty()) GTEST_SKIP() << "needs " << folder;
  const DirectDifferences d12 = directDifferences(makePicture(load(1)), makePicture(load(2)));
  const DirectDifferences d16 = directDifferences(makePicture(load(1)), makePicture(load(6)));
  const double half_a_digit = 0.5e-5;  // the reference has five digits
  EXPECT_NEAR(d12.boolean_rgb, 0.99980, half_a_digit);
  EXPECT_NEAR(d12.euclidean_rgb, 0.03556, half_a_digit);
  EXPECT_NEAR(d16.boolean_rgb, 0.99997, half_a_digit);
  EXPECT_NEAR(d16.euclidean_rgb, 0.12728, half_a_digit);
}

}  // namespace
}  // namespace sunlit::evaluate
