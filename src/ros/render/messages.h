/// From our types to ROS messages. Pure functions.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <Eigen/Geometry>
#include <string>

#include "sunlit/image/camera.h"
#include "sunlit/image/images.h"
#include "sunlit/ros/frame_names.h"

namespace sunlit::ros_interface {

/// An image of the optical frame, taken at `stamp`.
std_msgs::Header opticalHeader(const ros::Time& stamp);

/// Encoding rgb8.
sensor_msgs::ImagePtr toImageMessage(const image::Rgb8Image& picture, const std_msgs::Header& header);
/// Encoding 32FC1, m along the optical axis, NaN where there is nothing (REP-117, REP-118).
sensor_msgs::ImagePtr toImageMessage(const image::DepthImage& depth, const std_msgs::Header& header);
/// No distortion: model plumb_bob with zeros, rectification the identity.
sensor_msgs::CameraInfo toCameraInfo(const image::PinholeCamera& camera, const std_msgs::Header& header);

geometry_msgs::Pose toPose(const Eigen::Isometry3d& frame_from_body);
geometry_msgs::TransformStamped toTransform(const Eigen::Isometry3d& parent_from_child,
                                            const std::string& parent, const std::string& child,
                                            const ros::Time& stamp);
/// Throws std::invalid_argument where the pose holds what is not finite or a quaternion far from unit length.
Eigen::Isometry3d fromPose(const geometry_msgs::Pose& pose);
Eigen::Isometry3d fromTransform(const geometry_msgs::Transform& transform);

}  // namespace sunlit::ros_interface
