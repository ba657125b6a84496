#include "ros/render/messages.h"

#include <sensor_msgs/distortion_models.h>
#include <sensor_msgs/image_encodings.h>

#include <boost/make_shared.hpp>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace sunlit::ros_interface {

namespace {

template <typename Value, int kChannels>
sensor_msgs::ImagePtr packed(const image::Picture<Value, kChannels>& picture, const std_msgs::Header& header,
                             const std::string& encoding) {
  auto message = boost::make_shared<sensor_msgs::Image>();
  message->header = header;
  message->width = static_cast<std::uint32_t>(picture.width);
  message->height = static_cast<std::uint32_t>(picture.height);
  message->encoding = encoding;
  const std::uint16_t one = 1;
  unsigned char lowest_byte = 0;
  std::memcpy(&lowest_byte, &one, 1);
  message->is_bigendian = lowest_byte == 0;
  message->step = static_cast<std::uint32_t>(picture.width) * kChannels * sizeof(Value);
  message->data.resize(picture.data.size() * sizeof(Value));
  std::memcpy(message->data.data(), picture.data.data(), message->data.size());
  return message;
}

Eigen::Isometry3d rigid(const Eigen::Vector3d& translation, const Eigen::Quaterniond& rotation) {
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.linear() = rotation.normalized().toRotationMatrix();
  transform.translation() = translation;
  return transform;
}

}  // namespace

std_msgs::Header opticalHeader(const ros::Time& stamp) {
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = kOpticalFrame;
  return header;
}

sensor_msgs::ImagePtr toImageMessage(const image::Rgb8Image& picture, const std_msgs::Header& header) {
  return packed(picture, header, sensor_msgs::image_encodings::RGB8);
}

sensor_msgs::ImagePtr toImageMessage(const image::DepthImage& depth, const std_msgs::Header& header) {
  return packed(depth, header, sensor_msgs::image_encodings::TYPE_32FC1);
}

sensor_msgs::CameraInfo toCameraInfo(const image::PinholeCamera& camera, const std_msgs::Header& header) {
  sensor_msgs::CameraInfo info;
  info.header = header;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.distortion_model = sensor_msgs::distortion_models::PLUMB_BOB;
  info.D.assign(5, 0.0);
  info.K = {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
  info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.P = {camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return info;
}

geometry_msgs::Pose toPose(const Eigen::Isometry3d& frame_from_body) {
  const Eigen::Quaterniond rotation(frame_from_body.linear());
  geometry_msgs::Pose pose;
  pose.position.x = frame_from_body.translation().x();
  pose.position.y = frame_from_body.translation().y();
  pose.position.z = frame_from_body.translation().z();
  pose.orientation.x = rotation.x();
  pose.orientation.y = rotation.y();
  pose.orientation.z = rotation.z();
  pose.orientation.w = rotation.w();
  return pose;
}

geometry_msgs::TransformStamped toTransform(const Eigen::Isometry3d& parent_from_child,
                                            const std::string& parent, const std::string& child,
                                            const ros::Time& stamp) {
  const geometry_msgs::Pose pose = toPose(parent_from_child);
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = stamp;
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  transform.transform.translation.x = pose.position.x;
  transform.transform.translation.y = pose.position.y;
  transform.transform.translation.z = pose.position.z;
  transform.transform.rotation = pose.orientation;
  return transform;
}

Eigen::Isometry3d fromPose(const geometry_msgs::Pose& pose) {
  const Eigen::Vector3d position(pose.position.x, pose.position.y, pose.position.z);
  const Eigen::Quaterniond rotation(pose.orientation.w, pose.orientation.x, pose.orientation.y,
                                    pose.orientation.z);
  if (!position.allFinite()) throw std::invalid_argument("pose.position must be finite");
  // Written so that NaN fails too. Hand-typed quaternions carry a few digits.
  if (!(std::abs(rotation.norm() - 1.0) < 0.01)) {
    throw std::invalid_argument("pose.orientation has the length " + std::to_string(rotation.norm()) +
                                ", but must be a quaternion of length 1");
  }
  return rigid(position, rotation);
}

Eigen::Isometry3d fromTransform(const geometry_msgs::Transform& transform) {
  return rigid({transform.translation.x, transform.translation.y, transform.translation.z},
               {transform.rotation.w, transform.rotation.x, transform.rotation.y, transform.rotation.z});
}

}  // namespace sunlit::ros_interface
