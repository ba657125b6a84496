#include "evaluate/features/detector_pool.h"

#include <utility>

namespace sunlit::evaluate {

DetectorPool::DetectorPool(const Detector& detector, std::shared_ptr<FeatureCache> cache)
    : detector_(detector), identity_(detector.identity()), idle_{detector.make()} {
  if (!identity_.empty()) cache_ = std::move(cache);
}

cv::Ptr<cv::Feature2D> DetectorPool::take() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!idle_.empty()) {
      cv::Ptr<cv::Feature2D> worker = idle_.back();
      idle_.pop_back();
      return worker;
    }
  }
  return detector_.make();
}

void DetectorPool::giveBack(cv::Ptr<cv::Feature2D> worker) {
  const std::lock_guard<std::mutex> lock(mutex_);
  idle_.push_back(std::move(worker));
}

Features DetectorPool::detect(const Picture& picture) {
  const cv::Mat seen = detector_.seen(picture);
  const std::string key = cache_ ? featureKey(identity_, seen) : "";
  if (cache_) {
    if (std::optional<Features> kept = cache_->find(key)) return std::move(*kept);
  }
  const cv::Ptr<cv::Feature2D> worker = take();
  // One that throws is not given back: what it holds then is unknown.
  Features features = detectFeatures(*worker, seen);
  giveBack(worker);
  if (cache_) cache_->keep(key, features);
  return features;
}

}  // namespace sunlit::evaluate
