#include "ros/conversions/geometry.h"

#include <tf2_eigen/tf2_eigen.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "sunlit/quantity/frames.h"
#include "sunlit/quantity/range.h"

namespace sunlit::ros_interface {

namespace {

Eigen::Isometry3d rigid(const Eigen::Vector3d& translation, const Eigen::Quaterniond& rotation) {
  return Eigen::Translation3d(translation) * rotation.normalized();
}

}  // namespace

std_msgs::Header headerOf(const std::string& frame, const ros::Time& stamp) {
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = frame;
  return header;
}

geometry_msgs::Pose toPose(const Eigen::Isometry3d& frame_from_body) {
  return tf2::toMsg(frame_from_body);
}

geometry_msgs::TransformStamped toTransform(const Eigen::Isometry3d& parent_from_child,
                                            const std_msgs::Header& header, const std::string& child) {
  geometry_msgs::TransformStamped transform = tf2::eigenToTransform(parent_from_child);
  // As a pose has it, so that the two agree to the bit.
  transform.transform.rotation = toPose(parent_from_child).orientation;
  transform.header = header;
  transform.child_frame_id = child;
  return transform;
}

Eigen::Isometry3d fromPose(const geometry_msgs::Pose& pose) {
  Eigen::Vector3d position;
  Eigen::Quaterniond rotation;
  tf2::fromMsg(pose.position, position);
  tf2::fromMsg(pose.orientation, rotation);
  for (int axis = 0; axis < 3; ++axis)
    require(std::string("pose.position.") + "xyz"[axis], position[axis], kPoseRange_m, "m");
  // Written so that NaN fails too.
  if (!(std::abs(rotation.norm() - 1.0) < kUnitLength)) {
    throw std::invalid_argument("pose.orientation has the length " + std::to_string(rotation.norm()) +
                                ", but must be a quaternion of length 1");
  }
  return rigid(position, rotation);
}

Eigen::Isometry3d fromTransform(const geometry_msgs::Transform& transform) {
  Eigen::Vector3d translation;
  Eigen::Quaterniond rotation;
  tf2::fromMsg(transform.translation, translation);
  tf2::fromMsg(transform.rotation, rotation);
  return rigid(translation, rotation);
}

}  // namespace sunlit::ros_interface
