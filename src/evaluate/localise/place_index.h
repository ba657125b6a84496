/// Key frames that look like a picture as a whole.
#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "sunlit/evaluate/features/detector.h"
#include "sunlit/evaluate/localise/map.h"

namespace sunlit::evaluate {

/// VLAD (see places/vlad.h) of the features that a map keeps, with words of that map alone.
class PlaceIndex {
 public:
  /// `space` is that of the detector's descriptors. A map in the dark, of fewer different descriptors than
  /// two for each of kVisualWords, has one word for every two of them.
  PlaceIndex(const DescriptorSpace& space, const std::vector<KeyFrame>& frames);
  /// At most `count` indices, nearest first; of equally near ones the lower. Those without features, or with
  /// no more than words, are never found, and nothing is by such a picture, nor without words.
  std::vector<std::size_t> nearest(const cv::Mat& descriptors, std::size_t count) const;

 private:
  cv::Mat encode(const cv::Mat& descriptors) const;

  DescriptorSpace space_;
  cv::Mat words_;  // empty where there are none
  std::vector<cv::Mat> frames_;
};

}  // namespace sunlit::evaluate
