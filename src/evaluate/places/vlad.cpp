#include "sunlit/evaluate/places/vlad.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "evaluate/features/root_sift.h"
#include "evaluate/places/word_search.h"
#include "sunlit/quantity/vector_clones.h"

namespace sunlit::evaluate {
namespace {

cv::Mat bitsOf(const cv::Mat& bytes) {
  constexpr int kBits = 8;
  cv::Mat bits(bytes.rows, bytes.cols * kBits, CV_32FC1);
  for (int i = 0; i < bytes.rows; ++i) {
    for (int k = 0; k < bits.cols; ++k)
      bits.at<float>(i, k) = static_cast<float>(bytes.at<std::uint8_t>(i, k / kBits) >> k % kBits & 1);
  }
  return bits;
}

/// To length 1; what is 0 stays so.
void normalise(double* values, std::size_t size) {
  double squares = 0.0;
  for (std::size_t k = 0; k < size; ++k) squares += values[k] * values[k];
  if (squares == 0.0) return;
  const double length = std::sqrt(squares);
  for (std::size_t k = 0; k < size; ++k) values[k] /= length;
}

/// In lanes that are added up in one order, whatever the machine's vectors; so many that a compiler keeps the
/// inner loop and runs it in vectors.
SUNLIT_VECTOR_CLONES
double squaredDistance(const float* a, const float* b, std::size_t size) {
  constexpr std::size_t kLanes = 64;
  double sums[kLanes] = {};
  std::size_t k = 0;
  for (; k + kLanes <= size; k += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const double off = static_cast<double>(a[k + lane]) - b[k + lane];
      sums[lane] += off * off;
    }
  }
  for (std::size_t lane = 0; k < size; ++k, ++lane) {
    const double off = static_cast<double>(a[k]) - b[k];
    sums[lane] += off * off;
  }
  double sum = 0.0;
  for (const double lane : sums) sum += lane;
  return sum;
}

bool isZero(const cv::Mat& vlad) {
  return cv::countNonZero(vlad) == 0;
}

}  // namespace

cv::Mat vladPoints(const DescriptorSpace& space, const cv::Mat& descriptors) {
  if (descriptors.empty()) return {};
  if (space.norm == cv::NORM_HAMMING || space.norm == cv::NORM_HAMMING2) return bitsOf(descriptors);
  if (space.histograms) return rootSift(descriptors);
  cv::Mat points;
  descriptors.convertTo(points, CV_32FC1);
  return points;
}

cv::Mat vladTrainingDescriptors(const std::vector<cv::Mat>& by_picture) {
  std::size_t all = 0;
  for (const cv::Mat& descriptors : by_picture) all += static_cast<std::size_t>(descriptors.rows);
  const std::size_t wanted = std::min(all, kMostTrainingDescriptors);
  cv::Mat chosen;
  std::size_t before = 0, taken = 0;
  for (const cv::Mat& descriptors : by_picture) {
    for (int row = 0; row < descriptors.rows; ++row, ++before) {
      if (taken == wanted || before != taken * all / wanted) continue;
      cv::Mat next = descriptors.row(row);
      if (!chosen.empty() && next.type() != chosen.type()) {
        if (chosen.type() != CV_32FC1) chosen.convertTo(chosen, CV_32F);
        if (next.type() != CV_32FC1) next.convertTo(next, CV_32F);
      }
      chosen.push_back(next);
      ++taken;
    }
  }
  return chosen;
}

cv::Mat vladOf(const cv::Mat& points, const cv::Mat& words) {
  const auto width = static_cast<std::size_t>(words.cols);
  std::vector<double> sums(static_cast<std::size_t>(words.rows) * width, 0.0);
  const std::vector<NearestWord> found = WordSearch(words).nearest(points);
  for (int i = 0; i < points.rows; ++i) {
    const float* const point = points.ptr<float>(i);
    const int nearest = found[static_cast<std::size_t>(i)].word;
    const float* const word = words.ptr<float>(nearest);
    double* const sum = sums.data() + static_cast<std::size_t>(nearest) * width;
    for (std::size_t d = 0; d < width; ++d) sum[d] += static_cast<double>(point[d]) - word[d];
  }
  for (std::size_t at = 0; at < sums.size(); at += width) normalise(sums.data() + at, width);
  normalise(sums.data(), sums.size());
  cv::Mat vlad(1, static_cast<int>(sums.size()), CV_32FC1);
  for (std::size_t k = 0; k < sums.size(); ++k)
    vlad.at<float>(static_cast<int>(k)) = static_cast<float>(sums[k]);
  return vlad;
}

PlaceMatrix vladDistances(const std::vector<cv::Mat>& queries, const std::vector<cv::Mat>& map) {
  PlaceMatrix distances =
      PlaceMatrix::Constant(static_cast<Eigen::Index>(queries.size()), static_cast<Eigen::Index>(map.size()),
                            std::numeric_limits<double>::infinity());
  std::vector<char> is_blank(map.size());
  for (std::size_t j = 0; j < map.size(); ++j) is_blank[j] = isZero(map[j]) ? 1 : 0;
  tbb::parallel_for(std::size_t{0}, queries.size(), [&](std::size_t i) {
    if (isZero(queries[i])) return;
    for (std::size_t j = 0; j < map.size(); ++j) {
      if (is_blank[j] != 0) continue;
      distances(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = std::sqrt(squaredDistance(
          queries[i].ptr<float>(), map[j].ptr<float>(), static_cast<std::size_t>(map[j].cols)));
    }
  });
  return distances;
}

}  // namespace sunlit::evaluate
