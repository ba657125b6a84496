/// What an evaluation takes and gives, from and to ROS messages. Pure functions.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sunlit/Capture.h>
#include <sunlit/Localisation.h>
#include <sunlit/LocalisationSummary.h>
#include <sunlit/PairDifference.h>
#include <sunlit/Summary.h>

#include <Eigen/Geometry>

#include <opencv2/core/mat.hpp>
#include <vector>

#include "sunlit/evaluate/run/evaluation.h"

namespace sunlit::ros_interface {

evaluate::CaptureRecord captureOf(const Capture& message);
/// Its yaw is NaN where the orientation is no quaternion of length 1.
evaluate::PlaceRecord placeOf(const geometry_msgs::PoseStamped& message);
/// Where the camera's optical frame stood in `map`, from the pose of camera_link.
evaluate::Told<Eigen::Isometry3d> truePoseOf(const geometry_msgs::PoseStamped& message);
/// Of pictures of `topic`, which are rectified or not.
evaluate::Told<evaluate::ViewCamera> cameraOf(const sensor_msgs::CameraInfo& message,
                                              const std::string& topic);
evaluate::Told<cv::Mat> depthOf(const sensor_msgs::Image& message, std::size_t max_pixels);
PairDifference messageOf(const evaluate::EvaluationOptions& options, const evaluate::PairRecord& record);
/// rgb8.
sensor_msgs::ImagePtr messageOf(const cv::Mat& rgb, const std_msgs::Header& header);
/// Poses of camera_link in `map_frame`.
Localisation messageOf(const evaluate::LocalisationRow& row, const std::string& map_frame);
LocalisationSummary messageOf(const std::vector<evaluate::LocalisationSummary>& rows);
Summary messageOf(const std::vector<evaluate::SummaryRow>& rows, std::size_t poses);

}  // namespace sunlit::ros_interface
