/// ROS messages to what the evaluation understands. Pure functions.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/time.h>
#include <sensor_msgs/Image.h>
#include <sunlit/Capture.h>
#include <sunlit/PairDifference.h>
#include <sunlit/Summary.h>

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "sunlit/evaluate/evaluation.h"

namespace sunlit::ros_interface {

/// ns since the epoch of ROS time.
std::int64_t nanosecondsOf(const ros::Time& time);
ros::Time timeOf(std::int64_t nanoseconds);

/// An image as three channels of 8 bit, red first, or why it could not be had.
struct DecodedImage {
  cv::Mat rgb;
  std::string fault;
};
/// rgb8, bgr8, mono8, rgba8 and bgra8 (alpha is left out). Everything else, and data that do not fit the
/// named size, is a fault.
DecodedImage decode(const sensor_msgs::Image& message);

evaluate::CaptureRecord captureOf(const Capture& message);
evaluate::PlaceRecord placeOf(const geometry_msgs::PoseStamped& message);
PairDifference messageOf(const evaluate::EvaluationOptions& options, const evaluate::PairRecord& record);
/// rgb8.
sensor_msgs::Image messageOf(const cv::Mat& rgb, const std_msgs::Header& header);
Summary messageOf(const std::vector<evaluate::SummaryRow>& rows, std::size_t poses);

}  // namespace sunlit::ros_interface
