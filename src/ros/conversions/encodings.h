/// What cv_bridge knows of ROS's encodings of images. It brings OpenCV's codecs along (image/codecs.h), and
/// is loaded by the first call that asks for more than copies of rgb8 or depth.
#pragma once

#include <sensor_msgs/Image.h>

#include <opencv2/core/mat.hpp>
#include <string>

namespace sunlit::ros_interface {

/// OpenCV's type of pixels of `encoding`. Throws as cv_bridge::getCvType().
int typeOf(const std::string& encoding);
/// The pixels of `message` in `encoding`, copied; numbers are in this machine's order of bytes, and the data
/// fit the size. Throws as cv_bridge::toCvCopy().
cv::Mat pixelsOf(const sensor_msgs::Image& message, const std::string& encoding);
/// `pixels` of one encoding in another, copied. Throws as cv_bridge::cvtColor().
cv::Mat recoded(const cv::Mat& pixels, const std::string& from, const std::string& to);

}  // namespace sunlit::ros_interface
