#include "ros/conversions/encodings_by_cv_bridge.h"

#include <cv_bridge/cv_bridge.h>

#include <boost/make_shared.hpp>

namespace sunlit::ros_interface {
namespace {

cv::Mat copyOf(const sensor_msgs::Image& message, const std::string& encoding) {
  return cv_bridge::toCvCopy(message, encoding)->image;
}

cv::Mat converted(const cv::Mat& pixels, const std::string& from, const std::string& to) {
  return cv_bridge::cvtColor(boost::make_shared<cv_bridge::CvImage>(std_msgs::Header(), from, pixels), to)
      ->image;
}

}  // namespace
}  // namespace sunlit::ros_interface

const sunlit::ros_interface::Encodings* sunlitEncodings() {
  static const sunlit::ros_interface::Encodings encodings{cv_bridge::getCvType, sunlit::ros_interface::copyOf,
                                                          sunlit::ros_interface::converted};
  return &encodings;
}
