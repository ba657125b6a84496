#include "evaluate/localise/place_index.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "sunlit/evaluate/places/vlad.h"

namespace sunlit::evaluate {
namespace {

/// One for every two different points where these are few: a feature tells by how far it is off its word.
int wordsFor(const cv::Mat& points) {
  std::set<std::string> different;
  const std::size_t enough = 2 * kVisualWords;
  for (int i = 0; i < points.rows && different.size() < enough; ++i) {
    const auto* const row = points.ptr<char>(i);
    different.emplace(row, row + static_cast<std::size_t>(points.cols) * points.elemSize());
  }
  return static_cast<int>(different.size() / 2);
}

}  // namespace

PlaceIndex::PlaceIndex(const DescriptorSpace& space, const std::vector<KeyFrame>& frames)
    : space_(space), frames_(frames.size()) {
  std::vector<cv::Mat> descriptors;
  for (const KeyFrame& frame : frames) descriptors.push_back(frame.descriptors);
  const cv::Mat training = vladPoints(space_, vladTrainingDescriptors(descriptors));
  const int words = wordsFor(training);
  if (words == 0) return;
  words_ = trainVocabulary(training, words, kVocabularySeed);
  tbb::parallel_for(std::size_t{0}, frames.size(),
                    [&](std::size_t i) { frames_[i] = encode(frames[i].descriptors); });
}

std::vector<std::size_t> PlaceIndex::nearest(const cv::Mat& descriptors, std::size_t count) const {
  if (words_.empty()) return {};
  const PlaceMatrix distances = vladDistances({encode(descriptors)}, frames_);
  const auto distance = [&](std::size_t i) { return distances(0, static_cast<Eigen::Index>(i)); };
  std::vector<std::size_t> order(frames_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  order.erase(
      std::remove_if(order.begin(), order.end(), [&](std::size_t i) { return std::isinf(distance(i)); }),
      order.end());
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t l, std::size_t r) { return distance(l) < distance(r); });
  order.resize(std::min(order.size(), count));
  return order;
}

cv::Mat PlaceIndex::encode(const cv::Mat& descriptors) const {
  return vladOf(vladPoints(space_, descriptors), words_);
}

}  // namespace sunlit::evaluate
