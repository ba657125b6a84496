#include "evaluate/localise/place_index.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/core.hpp>
#include <utility>

#include "sunlit/evaluate/places/vlad.h"

namespace sunlit::evaluate {
namespace {

/// As detectors give them; key frames keep some as bytes.
cv::Mat givenAs(int norm, const cv::Mat& descriptors) {
  cv::Mat given = descriptors;
  if (norm == cv::NORM_L2 && !descriptors.empty()) descriptors.convertTo(given, CV_32F);
  return given;
}

}  // namespace

PlaceIndex::PlaceIndex(const DescriptorSpace& space, const std::vector<KeyFrame>& frames)
    : space_(space), frames_(frames.size()) {
  std::vector<cv::Mat> descriptors;
  for (const KeyFrame& frame : frames) descriptors.push_back(frame.descriptors);
  const cv::Mat training = vladTrainingDescriptors(descriptors);
  words_ = trainVocabulary(vladPoints(space_, givenAs(space_.norm, training)), kVisualWords, kVocabularySeed);
  tbb::parallel_for(std::size_t{0}, frames.size(),
                    [&](std::size_t i) { frames_[i] = encode(frames[i].descriptors); });
}

std::vector<std::size_t> PlaceIndex::nearest(const cv::Mat& descriptors, std::size_t count) const {
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
  return vladOf(vladPoints(space_, givenAs(space_.norm, descriptors)), words_);
}

}  // namespace sunlit::evaluate
