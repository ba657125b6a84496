// Where detectors say that things are, by pictures in which it is known: this decides for the OpenCV at hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "sunlit/evaluate/features/detector.h"

namespace sunlit::evaluate {
namespace {

/// A Gaussian about `centre`, the centre of the top left pixel being (0, 0).
cv::Mat blobAt(const cv::Point2d& centre, double sigma_px) {
  cv::Mat picture(140, 130, CV_8U);
  for (int y = 0; y < picture.rows; ++y) {
    for (int x = 0; x < picture.cols; ++x) {
      const double squared = std::pow(x - centre.x, 2) + std::pow(y - centre.y, 2);
      picture.at<std::uint8_t>(y, x) =
          cv::saturate_cast<std::uint8_t>(60.0 + 120.0 * std::exp(-0.5 * squared / (sigma_px * sigma_px)));
    }
  }
  return picture;
}

struct Offsets {
  std::vector<double> x, y;
  void add(const cv::Point2d& offset) {
    x.push_back(offset.x);
    y.push_back(offset.y);
  }
};

double medianOf(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Of medians: where maxima are flat, as those of corners are, some are found a pixel beside.
void expectNone(const Offsets& offsets, double tolerance_px) {
  EXPECT_NEAR(medianOf(offsets.x), 0.0, tolerance_px) << offsets.x.size();
  EXPECT_NEAR(medianOf(offsets.y), 0.0, tolerance_px) << offsets.x.size();
}

TEST(PixelCentres, BlobsAreFoundWhereTheyAre) {
  for (const std::string& type : readyDetectorTypes()) {
    if (type == "orb" || type == "brisk") continue;  // which look for corners
    SCOPED_TRACE(type);
    const std::unique_ptr<Detector> detector = makeDetector(type);
    Offsets offsets;
    for (const double sigma_px : {2.0, 3.0, 4.5}) {
      for (int i = 0; i < 8; ++i) {
        const cv::Point2d centre(60.0 + 0.13 * i, 71.0 - 0.29 * i);
        for (const cv::KeyPoint& found :
             detectFeatures(*detector, Picture{{}, blobAt(centre, sigma_px)}).key_points) {
          const cv::Point2d off = cv::Point2d(found.pt) - centre;
          if (cv::norm(off) > 0.5 * sigma_px) continue;  // on its rim
          offsets.add(off);
        }
      }
    }
    ASSERT_GT(offsets.x.size(), 20u);
    // SIFT's quarter of a pixel is five times that.
    expectNone(offsets, 0.05);
  }
}

/// What detectors see as corners and blobs, of sizes that are no multiple of any level's.
cv::Mat madePicture() {
  cv::Mat sum(359, 477, CV_32F, cv::Scalar(128.0));
  cv::RNG generator(std::uint64_t{3});
  for (const double sigma_px : {1.2, 2.5, 5.0, 10.0}) {
    cv::Mat noise(sum.size(), CV_32F);
    generator.fill(noise, cv::RNG::NORMAL, 0.0, 1.0);
    cv::GaussianBlur(noise, noise, {}, sigma_px);
    sum += noise * (50.0 * sigma_px);
  }
  cv::Mat picture;
  sum.convertTo(picture, CV_8U);
  return picture;
}

/// By KeyPoint::octave, half of the way from where a key point is to where it is found in the picture that is
/// turned by 180°, and turned back.
std::map<int, Offsets> halfWays(const Detector& detector, const cv::Mat& picture) {
  cv::Mat turned;
  cv::rotate(picture, turned, cv::ROTATE_180);
  const Features upright = detectFeatures(detector, Picture{{}, picture});
  std::vector<cv::KeyPoint> back = detectFeatures(detector, Picture{{}, turned}).key_points;
  for (cv::KeyPoint& point : back)
    point.pt =
        cv::Point2f(static_cast<float>(picture.cols - 1), static_cast<float>(picture.rows - 1)) - point.pt;
  std::map<int, Offsets> by_octave;
  for (const cv::KeyPoint& a : upright.key_points) {
    double nearest = 1.5;  // px: others of its level are further away, mostly
    cv::Point2d way;
    for (const cv::KeyPoint& b : back) {
      if ((a.octave & 0xff) != (b.octave & 0xff) || std::abs(a.size - b.size) > 0.1F * a.size) continue;
      const cv::Point2d between(b.pt - a.pt);
      if (cv::norm(between) >= nearest) continue;
      nearest = cv::norm(between);
      way = between;
    }
    if (nearest == 1.5) continue;
    by_octave[a.octave & 0xff].add(0.5 * way);
  }
  return by_octave;
}

TEST(PixelCentres, AreTheSameInAPictureThatIsTurned) {
  const cv::Mat picture = madePicture();
  for (const std::string& type : readyDetectorTypes()) {
    const std::unique_ptr<Detector> detector = makeDetector(type);
    if (type == "orb") fieldOf(detector->fields(), "n_features").set(10000, "");
    std::size_t octaves = 0;
    for (const auto& [octave, offsets] : halfWays(*detector, picture)) {
      if (offsets.x.size() < 100) continue;
      SCOPED_TRACE(type + " " + std::to_string(octave));
      ++octaves;
      // BRISK's is found in the picture itself (octave 0: 0.12 px). What levels are shifted by is half a
      // pixel.
      expectNone(offsets, type == "brisk" ? 0.2 : 0.05);
    }
    EXPECT_GE(octaves, 1u) << type;
  }
}

}  // namespace
}  // namespace sunlit::evaluate
