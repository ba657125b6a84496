// A detector of one's own: the strongest corners, described by what ORB has.
#include <opencv2/features2d.hpp>
#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "sunlit/evaluate/features/detector_plugin.h"

namespace example_detectors {

class Corners : public sunlit::evaluate::DetectorPlugin {
 public:
  std::vector<sunlit::Field> fields() override {
    return {{"n_features", &n_features_, "", {1, 1e6}, "best ones kept"},
            {"threshold", &threshold_, "grey levels", {1, 255}, "of FAST"}};
  }
  std::vector<cv::KeyPoint> detect(const cv::Mat& grey) override {
    if (grey.cols < kSmallest_px || grey.rows < kSmallest_px)
      throw std::runtime_error("a picture must have at least 16 px along each side");
    std::vector<cv::KeyPoint> points;
    worker()->detect(grey, points);
    return points;
  }
  cv::Mat describe(const cv::Mat& grey, std::vector<cv::KeyPoint>& key_points) override {
    cv::Mat descriptors;
    worker()->compute(grey, key_points, descriptors);
    return descriptors;
  }
  int norm() const override { return cv::NORM_HAMMING; }
  std::string version() const override { return "1"; }

 private:
  static constexpr int kSmallest_px = 16;

  cv::Ptr<cv::ORB> worker() const {
    return cv::ORB::create(n_features_, 1.2F, 8, 31, 0, 2, cv::ORB::HARRIS_SCORE, 31, threshold_);
  }

  int n_features_ = 500;
  int threshold_ = 20;
};

}  // namespace example_detectors

PLUGINLIB_EXPORT_CLASS(example_detectors::Corners, sunlit::evaluate::DetectorPlugin)
