#include "evaluate/features/detector_pool.h"

#include <utility>

namespace sunlit::evaluate {

cv::Ptr<cv::Feature2D> DetectorPool::take(Difference difference) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    auto& idle = idle_[difference];
    if (!idle.empty()) {
      cv::Ptr<cv::Feature2D> detector = idle.back();
      idle.pop_back();
      return detector;
    }
  }
  return makeDetector(difference, options_);
}

void DetectorPool::giveBack(Difference difference, cv::Ptr<cv::Feature2D> detector) {
  const std::lock_guard<std::mutex> lock(mutex_);
  idle_[difference].push_back(std::move(detector));
}

Features DetectorPool::detect(Difference difference, const cv::Mat& grey) {
  const cv::Ptr<cv::Feature2D> detector = take(difference);
  Features features;
  // One that throws is not given back: what it holds then is unknown.
  detector->detectAndCompute(grey, cv::noArray(), features.key_points, features.descriptors);
  giveBack(difference, detector);
  return features;
}

}  // namespace sunlit::evaluate
