/// What TF says of a frame.
#pragma once

#include <ros/time.h>
#include <tf2_ros/buffer.h>

#include <Eigen/Geometry>
#include <string>

namespace sunlit::ros_interface {

struct FoundTransform {
  Eigen::Isometry3d parent_from_child;
  ros::Time stamp;  ///< zero: it is static
};

/// At `stamp`; zero: the latest. Throws tf2::TransformException where TF does not know, and, with a warning
/// that names the frame, where what it knows is not finite: it lets infinite translations pass. One thread at
/// a time.
FoundTransform lookUp(const tf2_ros::Buffer& tf, const std::string& parent, const std::string& child,
                      const ros::Time& stamp);

}  // namespace sunlit::ros_interface
