#include "evaluate/places/word_search.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <limits>

#include "sunlit/quantity/vector_clones.h"

namespace sunlit::evaluate {
namespace {

constexpr std::size_t kWordsAtOnce = 16;
constexpr std::size_t kPointsPerTask = 256;

/// Squared distances of a point to one block of words.
SUNLIT_VECTOR_CLONES
void distancesToBlock(const float* point, const float* block, std::size_t coordinates, float* distances2) {
  float sums[kWordsAtOnce] = {};
  for (std::size_t d = 0; d < coordinates; ++d) {
    for (std::size_t w = 0; w < kWordsAtOnce; ++w) {
      const float off = point[d] - block[d * kWordsAtOnce + w];
      sums[w] += off * off;
    }
  }
  for (std::size_t w = 0; w < kWordsAtOnce; ++w) distances2[w] = sums[w];
}

}  // namespace

WordSearch::WordSearch(const cv::Mat& words)
    : words_(words.rows), coordinates_(static_cast<std::size_t>(words.cols)) {
  const std::size_t blocks = (static_cast<std::size_t>(words_) + kWordsAtOnce - 1) / kWordsAtOnce;
  table_.assign(blocks * kWordsAtOnce * coordinates_, 0.0F);
  for (int w = 0; w < words_; ++w) {
    const std::size_t block = static_cast<std::size_t>(w) / kWordsAtOnce;
    const std::size_t lane = static_cast<std::size_t>(w) % kWordsAtOnce;
    for (std::size_t d = 0; d < coordinates_; ++d)
      table_[(block * coordinates_ + d) * kWordsAtOnce + lane] = words.at<float>(w, static_cast<int>(d));
  }
}

NearestWord WordSearch::nearest(const float* point) const {
  NearestWord best{0, std::numeric_limits<float>::infinity()};
  float distances2[kWordsAtOnce];
  for (int w = 0; w < words_; ++w) {
    const std::size_t lane = static_cast<std::size_t>(w) % kWordsAtOnce;
    if (lane == 0)
      distancesToBlock(point, table_.data() + static_cast<std::size_t>(w) * coordinates_, coordinates_,
                       distances2);
    if (distances2[lane] < best.distance2) best = {w, distances2[lane]};
  }
  return best;
}

std::vector<NearestWord> WordSearch::nearest(const cv::Mat& points) const {
  std::vector<NearestWord> found(static_cast<std::size_t>(points.rows));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, found.size(), kPointsPerTask),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i)
                        found[i] = nearest(points.ptr<float>(static_cast<int>(i)));
                    });
  return found;
}

}  // namespace sunlit::evaluate
