/// One detector, to use again.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "sunlit/evaluate/features/detector.h"
#include "sunlit/evaluate/features/feature_cache.h"

namespace sunlit::evaluate {

/// What Detector::make() makes is not to be shared between threads, and making it costs up to 30 ms (BRISK
/// computes the pattern of every scale and rotation). So each is lent to one task at a time. Thread-safe.
class DetectorPool {
 public:
  /// `detector` outlives the pool and does not change. What is in `cache`, which may be null, is not found
  /// again.
  /// Throws what Detector::make() throws, such as for parameters that do not go together.
  DetectorPool(const Detector& detector, std::shared_ptr<FeatureCache> cache);
  Features detect(const Picture& picture);

 private:
  cv::Ptr<cv::Feature2D> take();
  void giveBack(cv::Ptr<cv::Feature2D> worker);

  const Detector& detector_;
  std::shared_ptr<FeatureCache> cache_;  // null where its features are not kept
  std::string identity_;
  std::mutex mutex_;
  std::vector<cv::Ptr<cv::Feature2D>> idle_;
};

}  // namespace sunlit::evaluate
