// trainVocabulary(): k-means whose every sum has one order.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <random>
#include <stdexcept>

#include "evaluate/places/word_search.h"
#include "sunlit/evaluate/places/vlad.h"

namespace sunlit::evaluate {
namespace {

/// In [0, 1), in steps of 2⁻⁵³; std::uniform_real_distribution differs between standard libraries.
double uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1p-53;
}

/// The first index at which the sum of the weights up to it exceeds `share` of their total, which is not 0.
int drawn(const std::vector<double>& weights, double total, double share) {
  double sum = 0.0;
  int last = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] <= 0.0) continue;
    sum += weights[i];
    last = static_cast<int>(i);
    if (sum > share * total) break;
  }
  return last;
}

double sumOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum;
}

/// k-means++: each word is a point, drawn with a chance that goes as the square of its distance to the
/// nearest of those before.
cv::Mat firstWords(const cv::Mat& points, int count, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  cv::Mat words;
  std::vector<double> weights(static_cast<std::size_t>(points.rows), 1.0);
  for (int w = 0; w < count; ++w) {
    const double total = sumOf(weights);
    if (total <= 0.0) {
      throw std::invalid_argument("different descriptors of the map are " + std::to_string(w) +
                                  ", but must be at least " + std::to_string(count) +
                                  ", one for each visual word");
    }
    words.push_back(points.row(drawn(weights, total, uniform(generator))));
    const std::vector<NearestWord> to_newest = WordSearch(words.row(w)).nearest(points);
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double distance2 = to_newest[i].distance2;
      weights[i] = w == 0 ? distance2 : std::min(weights[i], distance2);
    }
  }
  return words;
}

/// The mean of each word's points, summed up in their order.
void moveToMeans(const cv::Mat& points, const std::vector<NearestWord>& nearest, cv::Mat* words) {
  std::vector<std::vector<int>> members(static_cast<std::size_t>(words->rows));
  for (std::size_t i = 0; i < nearest.size(); ++i)
    members[static_cast<std::size_t>(nearest[i].word)].push_back(static_cast<int>(i));
  tbb::parallel_for(0, words->rows, [&](int w) {
    const std::vector<int>& own = members[static_cast<std::size_t>(w)];
    if (own.empty()) return;
    std::vector<double> sums(static_cast<std::size_t>(words->cols), 0.0);
    for (const int point : own) {
      const float* const from = points.ptr<float>(point);
      for (std::size_t d = 0; d < sums.size(); ++d) sums[d] += from[d];
    }
    float* const word = words->ptr<float>(w);
    for (std::size_t d = 0; d < sums.size(); ++d)
      word[d] = static_cast<float>(sums[d] / static_cast<double>(own.size()));
  });
}

bool sameWords(const std::vector<NearestWord>& a, const std::vector<NearestWord>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const NearestWord& x, const NearestWord& y) { return x.word == y.word; });
}

}  // namespace

cv::Mat trainVocabulary(const cv::Mat& points, int words, std::uint64_t seed) {
  cv::Mat vocabulary = firstWords(points, words, seed);
  std::vector<NearestWord> before;
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<NearestWord> nearest = WordSearch(vocabulary).nearest(points);
    if (sameWords(nearest, before)) break;
    moveToMeans(points, nearest, &vocabulary);
    before = std::move(nearest);
  }
  return vocabulary;
}

}  // namespace sunlit::evaluate
