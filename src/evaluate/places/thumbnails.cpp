#include "sunlit/evaluate/places/thumbnails.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace sunlit::evaluate {
namespace {

constexpr double kStepsPerSigma = 4096.0;
constexpr int kPatchPixels = kPatchSide * kPatchSide;

/// False where the patch is constant.
bool normalisePatch(const cv::Mat& grey, cv::Mat values) {
  // Whole-number sums: n Σx² − (Σx)² is exactly 0 where all are equal.
  std::int64_t sum = 0, squares = 0;
  for (int y = 0; y < kPatchSide; ++y) {
    for (int x = 0; x < kPatchSide; ++x) {
      const std::int64_t level = grey.at<std::uint8_t>(y, x);
      sum += level;
      squares += level * level;
    }
  }
  const std::int64_t spread = kPatchPixels * squares - sum * sum;
  if (spread == 0) return false;
  const double mean = static_cast<double>(sum) / kPatchPixels;
  const double sigma = std::sqrt(static_cast<double>(spread) / (kPatchPixels * (kPatchPixels - 1.0)));
  for (int y = 0; y < kPatchSide; ++y) {
    for (int x = 0; x < kPatchSide; ++x) {
      const double deviation = (grey.at<std::uint8_t>(y, x) - mean) / sigma;
      values.at<std::int16_t>(y, x) = static_cast<std::int16_t>(std::lround(deviation * kStepsPerSigma));
    }
  }
  return true;
}

}  // namespace

Thumbnail makeThumbnail(const cv::Mat& grey) {
  if (grey.empty() || grey.type() != CV_8UC1)
    throw std::invalid_argument("a thumbnail is made of a grey picture of 8 bit that is not empty");
  cv::Mat small;
  cv::resize(grey, small, {kThumbnailWidth, kThumbnailHeight}, 0, 0, cv::INTER_AREA);
  Thumbnail thumbnail;
  thumbnail.values = cv::Mat::zeros(small.size(), CV_16SC1);
  for (int y = 0; y < small.rows; y += kPatchSide) {
    for (int x = 0; x < small.cols; x += kPatchSide) {
      const cv::Rect patch(x, y, kPatchSide, kPatchSide);
      thumbnail.constant_patches += normalisePatch(small(patch), thumbnail.values(patch)) ? 0 : 1;
    }
  }
  return thumbnail;
}

PlaceMatrix thumbnailDifferences(const std::vector<Thumbnail>& queries, const std::vector<Thumbnail>& map) {
  constexpr double kUnit = kStepsPerSigma * kThumbnailWidth * kThumbnailHeight;  // a power of two
  PlaceMatrix differences(static_cast<Eigen::Index>(queries.size()), static_cast<Eigen::Index>(map.size()));
  tbb::parallel_for(std::size_t{0}, queries.size(), [&](std::size_t i) {
    for (std::size_t j = 0; j < map.size(); ++j) {
      differences(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
          cv::norm(queries[i].values, map[j].values, cv::NORM_L1) / kUnit;
    }
  });
  return differences;
}

}  // namespace sunlit::evaluate
