#include "sunlit/evaluate/places/thumbnails.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <stdexcept>

namespace sunlit::evaluate {
namespace {

constexpr double kStepsPerSigma = 4096.0;
constexpr int kPatchPixels = kPatchSide * kPatchSide;
constexpr std::int64_t kStepsPerLevel = 65536;  // as many as leave a patch's sums of squares below 2^63

/// Calls `visit` with each of `size` pixels that the part of so many equal parts covers, and by how much of
/// it, in 1/parts of a pixel.
template <typename Visit>
void forEachCovered(int part, int parts, int size, const Visit& visit) {
  const std::int64_t begin = std::int64_t{part} * size, end = begin + size;
  for (std::int64_t pixel = begin / parts; pixel * parts < end; ++pixel) {
    const std::int64_t covered = std::min(end, (pixel + 1) * parts) - std::max(begin, pixel * parts);
    visit(static_cast<int>(pixel), static_cast<int>(covered));
  }
}

/// CV_32SC1, in steps of a level. Of whole numbers: cv::resize would round to levels, of which a dark picture
/// has few.
cv::Mat meansOfAreas(const cv::Mat& grey) {
  cv::Mat means(kThumbnailHeight, kThumbnailWidth, CV_32SC1);
  const std::int64_t area = std::int64_t{grey.cols} * grey.rows;
  cv::Mat_<int> columns(1, grey.cols);
  for (int row = 0; row < means.rows; ++row) {
    columns.setTo(0);
    forEachCovered(row, means.rows, grey.rows, [&](int y, int covered) {
      const auto* levels = grey.ptr<std::uint8_t>(y);
      int* sums = columns[0];
      for (int x = 0; x < grey.cols; ++x) sums[x] += covered * levels[x];
    });
    for (int column = 0; column < means.cols; ++column) {
      std::int64_t sum = 0;
      forEachCovered(column, means.cols, grey.cols,
                     [&](int x, int covered) { sum += std::int64_t{covered} * columns(x); });
      means.at<int>(row, column) = static_cast<int>((sum * kStepsPerLevel + area / 2) / area);
    }
  }
  return means;
}

/// False where the patch is constant.
bool normalisePatch(const cv::Mat& means, cv::Mat values) {
  // Whole-number sums: n Σx² − (Σx)² is exactly 0 where all are equal.
  std::int64_t sum = 0, squares = 0;
  for (int y = 0; y < kPatchSide; ++y) {
    for (int x = 0; x < kPatchSide; ++x) {
      const std::int64_t mean = means.at<int>(y, x);
      sum += mean;
      squares += mean * mean;
    }
  }
  const std::int64_t spread = kPatchPixels * squares - sum * sum;
  if (spread == 0) return false;
  const double mean = static_cast<double>(sum) / kPatchPixels;
  const double sigma = std::sqrt(static_cast<double>(spread) / (kPatchPixels * (kPatchPixels - 1.0)));
  for (int y = 0; y < kPatchSide; ++y) {
    for (int x = 0; x < kPatchSide; ++x) {
      const double deviation = (means.at<int>(y, x) - mean) / sigma;
      values.at<std::int16_t>(y, x) = static_cast<std::int16_t>(std::lround(deviation * kStepsPerSigma));
    }
  }
  return true;
}

}  // namespace

Thumbnail makeThumbnail(const cv::Mat& grey) {
  if (grey.empty() || grey.type() != CV_8UC1)
    throw std::invalid_argument("a thumbnail is made of a grey picture of 8 bit that is not empty");
  const cv::Mat small = meansOfAreas(grey);
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
