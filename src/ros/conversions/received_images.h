/// Images from ROS messages, whoever sent them. Pure functions.
#pragma once

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>

#include "sunlit/evaluate/run/evaluation.h"

namespace sunlit::ros_interface {

/// ns since the epoch of ROS time.
std::int64_t nanosecondsOf(const ros::Time& time);
ros::Time timeOf(std::int64_t nanoseconds);

/// An image as three channels of 8 bit, red first, or why it could not be had.
struct DecodedImage {
  cv::Mat rgb;
  std::string fault;
  evaluate::ImageTraits traits;
};

/// Whatever cv_bridge can convert to rgb8: rgb, bgr, with alpha (left out), mono, Bayer, yuv422, of 8 or 16
/// bit in either order of bytes. 16 bit become v · 255 / 65535, rounded. All else is a fault that names it:
/// other encodings, more than `max_pixels` pixels, data that do not fit the size. Nothing is allocated before
/// the size is checked.
DecodedImage decode(const sensor_msgs::Image& message, std::size_t max_pixels);
/// PNG and JPEG, of grey or colour, 8 or 16 bit as above; by the data, whatever the message calls its format.
/// But where that begins with a Bayer encoding, as in "bayer_rggb8; png compressed ", the data are a mosaic
/// of one channel, as compressed_image_transport sends it, and the image is that of the raw one.
DecodedImage decode(const sensor_msgs::CompressedImage& message, std::size_t max_pixels);

/// Depth as CV_32FC1, m, or why it could not be had.
struct DecodedDepth {
  cv::Mat metres;
  std::string fault;
};

/// Encodings 32FC1, m, and 16UC1, mm with 0 for nothing (REP-118), in either order of bytes. What lies
/// outside of 1 mm to 1000 km is nothing, too, and a fault where most is such; so are whole numbers of metres
/// beyond 100 m, which are millimetres. All else is a fault, as above.
DecodedDepth decodeDepth(const sensor_msgs::Image& message, std::size_t max_pixels);

}  // namespace sunlit::ros_interface
