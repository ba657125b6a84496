#include "evaluate/features/detector_pool.h"

#include <utility>

namespace sunlit::evaluate {

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
  const cv::Ptr<cv::Feature2D> worker = take();
  // One that throws is not given back: what it holds then is unknown.
  Features features = detectFeatures(detector_, *worker, picture);
  giveBack(worker);
  return features;
}

}  // namespace sunlit::evaluate
