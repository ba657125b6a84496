#include "evaluate/places/word_search.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "sunlit/quantity/vector_clones.h"

namespace sunlit::evaluate {
namespace {

constexpr std::size_t kLanes = 16;  // words are filled up to a multiple of it
constexpr std::size_t kPointsPerTask = 256;

/// What a table of words is: coordinate by coordinate, those of all words side by side.
struct Table {
  const float* values;
  std::size_t coordinates;
  std::size_t width;
};

/// Squared distances to all words. Each has a sum of its own, so that loops over words run in vectors of any
/// length to the same bits.
SUNLIT_VECTOR_CLONES
void distancesTo(const Table& table, const float* point, float* __restrict distances2) {
  for (std::size_t w = 0; w < table.width; ++w) distances2[w] = 0.0F;
  for (std::size_t d = 0; d < table.coordinates; ++d) {
    const float at = point[d];
    const float* const words = table.values + d * table.width;
    for (std::size_t w = 0; w < table.width; ++w) {
      const float off = at - words[w];
      distances2[w] += off * off;
    }
  }
}

}  // namespace

WordSearch::WordSearch(const cv::Mat& words)
    : words_(static_cast<std::size_t>(words.rows)),
      coordinates_(static_cast<std::size_t>(words.cols)),
      width_((words_ + kLanes - 1) / kLanes * kLanes),
      table_(width_ * coordinates_, 0.0F) {
  for (int w = 0; w < words.rows; ++w) {
    for (int d = 0; d < words.cols; ++d)
      table_[static_cast<std::size_t>(d) * width_ + static_cast<std::size_t>(w)] = words.at<float>(w, d);
  }
}

NearestWord WordSearch::nearest(const float* point, std::vector<float>* distances2) const {
  distances2->resize(width_);
  distancesTo({table_.data(), coordinates_, width_}, point, distances2->data());
  const auto begin = distances2->begin();
  const auto least = std::min_element(begin, begin + static_cast<std::ptrdiff_t>(words_));
  return {static_cast<int>(least - begin), *least};
}

std::vector<NearestWord> WordSearch::nearest(const cv::Mat& points) const {
  std::vector<NearestWord> found(static_cast<std::size_t>(points.rows));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, found.size(), kPointsPerTask),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      std::vector<float> room;
                      for (std::size_t i = range.begin(); i < range.end(); ++i)
                        found[i] = nearest(points.ptr<float>(static_cast<int>(i)), &room);
                    });
  return found;
}

}  // namespace sunlit::evaluate
