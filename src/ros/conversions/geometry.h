/// Poses and transforms, to and from ROS messages. Pure functions.
#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/TransformStamped.h>
#include <std_msgs/Header.h>

#include <Eigen/Geometry>
#include <string>

namespace sunlit::ros_interface {

/// So far a quaternion's length may be from 1: hand-typed ones carry a few digits.
constexpr double kUnitLength = 0.01;

std_msgs::Header headerOf(const std::string& frame, const ros::Time& stamp);

geometry_msgs::Pose toPose(const Eigen::Isometry3d& frame_from_body);
/// `header` names the parent.
geometry_msgs::TransformStamped toTransform(const Eigen::Isometry3d& parent_from_child,
                                            const std_msgs::Header& header, const std::string& child);

/// Throws std::invalid_argument where the position is outside kPoseRange_m or the quaternion far from
/// unit length.
Eigen::Isometry3d fromPose(const geometry_msgs::Pose& pose);
/// The quaternion may have any length but 0.
Eigen::Isometry3d fromTransform(const geometry_msgs::Transform& transform);

}  // namespace sunlit::ros_interface
