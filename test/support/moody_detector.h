/// A detector of a researcher's own that throws at some pictures.
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <stdexcept>
#include <vector>

#include "sunlit/evaluate/features/detector_plugin.h"

namespace sunlit::evaluate {

constexpr const char* kMood = "detector tests/Moody: not this one";

/// The picture, at which it throws: its first pixels are white, black, white.
inline cv::Mat marked(const cv::Mat& rgb) {
  cv::Mat picture = rgb.clone();
  picture.colRange(0, 3).row(0) = cv::Scalar::all(255);
  picture.at<cv::Vec3b>(0, 1) = {0, 0, 0};
  return picture;
}

/// ORB of all others.
class Moody : public DetectorPlugin {
 public:
  std::vector<cv::KeyPoint> detect(const cv::Mat& grey) override {
    const auto at = [&](int x) { return static_cast<int>(grey.at<unsigned char>(0, x)); };
    if (at(0) == 255 && at(1) == 0 && at(2) == 255) throw std::runtime_error("not this one");
    std::vector<cv::KeyPoint> points;
    orb_->detect(grey, points);
    return points;
  }
  cv::Mat describe(const cv::Mat& grey, std::vector<cv::KeyPoint>& points) override {
    cv::Mat descriptors;
    orb_->compute(grey, points, descriptors);
    return descriptors;
  }
  int norm() const override { return cv::NORM_HAMMING; }

 private:
  cv::Ptr<cv::ORB> orb_ = cv::ORB::create();
};

inline std::unique_ptr<Detector> moodyDetector() {
  return makePluginDetector("tests/Moody", [] { return std::make_shared<Moody>(); });
}

}  // namespace sunlit::evaluate
