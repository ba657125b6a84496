/// Detectors to use again.
#pragma once

#include <map>
#include <mutex>
#include <opencv2/features2d.hpp>
#include <vector>

#include "sunlit/evaluate/features/features.h"

namespace sunlit::evaluate {

/// Detectors are not to be shared between threads, and making one costs up to 30 ms (BRISK computes the
/// pattern of every scale and rotation). So each is lent to one task at a time. Thread-safe.
class DetectorPool {
 public:
  explicit DetectorPool(const FeatureOptions& options) : options_(options) {}
  Features detect(Difference difference, const cv::Mat& grey);

 private:
  cv::Ptr<cv::Feature2D> take(Difference difference);
  void giveBack(Difference difference, cv::Ptr<cv::Feature2D> detector);

  FeatureOptions options_;
  std::mutex mutex_;
  std::map<Difference, std::vector<cv::Ptr<cv::Feature2D>>> idle_;
};

}  // namespace sunlit::evaluate
