/// What an evaluation takes and gives, from and to ROS messages. Pure functions.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <sensor_msgs/Image.h>
#include <sunlit/Capture.h>
#include <sunlit/PairDifference.h>
#include <sunlit/Summary.h>

#include <opencv2/core/mat.hpp>
#include <vector>

#include "sunlit/evaluate/run/evaluation.h"

namespace sunlit::ros_interface {

evaluate::CaptureRecord captureOf(const Capture& message);
/// Its yaw is NaN where the orientation is no quaternion of length 1.
evaluate::PlaceRecord placeOf(const geometry_msgs::PoseStamped& message);
PairDifference messageOf(const evaluate::EvaluationOptions& options, const evaluate::PairRecord& record);
/// rgb8.
sensor_msgs::ImagePtr messageOf(const cv::Mat& rgb, const std_msgs::Header& header);
Summary messageOf(const std::vector<evaluate::SummaryRow>& rows, std::size_t poses);

}  // namespace sunlit::ros_interface
