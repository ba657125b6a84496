#include "ros/render/camera_output.h"

#include <image_transport/camera_common.h>
#include <sensor_msgs/CompressedImage.h>

#include "ros/conversions/images.h"

namespace sunlit::ros_interface {

namespace {

/// ROS calls it on the thread that has its callbacks.
template <typename Link>
boost::function<void(const Link&)> adding(const std::shared_ptr<CameraSubscribers>& counted,
                                          int CameraSubscribers::*number, int change) {
  return [counted, number, change](const Link& /*link*/) { (*counted).*number += change; };
}

image_transport::CameraPublisher advertised(const ros::NodeHandle& node, const std::string& topic,
                                            std::uint32_t queue_size,
                                            const std::shared_ptr<CameraSubscribers>& counted) {
  using ImageLink = image_transport::SingleSubscriberPublisher;
  using InfoLink = ros::SingleSubscriberPublisher;
  return image_transport::ImageTransport(node).advertiseCamera(
      topic, queue_size, adding<ImageLink>(counted, &CameraSubscribers::images, 1),
      adding<ImageLink>(counted, &CameraSubscribers::images, -1),
      adding<InfoLink>(counted, &CameraSubscribers::infos, 1),
      adding<InfoLink>(counted, &CameraSubscribers::infos, -1));
}

}  // namespace

CameraOutput::CameraOutput(const ros::NodeHandle& node, const std::string& topic, std::uint32_t queue_size)
    : counted_(std::make_shared<CameraSubscribers>()),
      publisher_(advertised(node, topic, queue_size, counted_)) {}

void CameraOutput::publish(const image::Rgb8Image& picture, const sensor_msgs::CameraInfo& info) const {
  publisher_.publish(toImageMessage(picture, info.header), boost::make_shared<sensor_msgs::CameraInfo>(info));
}

void CameraOutput::publish(const image::DepthImage& depth, const sensor_msgs::CameraInfo& info) const {
  publisher_.publish(toImageMessage(depth, info.header), boost::make_shared<sensor_msgs::CameraInfo>(info));
}

std::string CameraOutput::lonelyTopic(const CameraSubscribers& wanted) const {
  if (counted_->images < wanted.images) return publisher_.getTopic();
  if (counted_->infos < wanted.infos) return publisher_.getInfoTopic();
  return std::string();
}

PngOutput::PngOutput(ros::NodeHandle node, const std::string& topic, std::uint32_t queue_size)
    : images_(node.advertise<sensor_msgs::CompressedImage>(topic + "/compressed", queue_size)),
      infos_(
          node.advertise<sensor_msgs::CameraInfo>(image_transport::getCameraInfoTopic(topic), queue_size)) {}

void PngOutput::publish(const image::Rgb8Image& picture, const sensor_msgs::CameraInfo& info) const {
  images_.publish(toPngMessage(picture, info.header));
  infos_.publish(info);
}

std::string PngOutput::lonelyTopic(const CameraSubscribers& wanted) const {
  if (static_cast<int>(images_.getNumSubscribers()) < wanted.images) return images_.getTopic();
  if (static_cast<int>(infos_.getNumSubscribers()) < wanted.infos) return infos_.getTopic();
  return std::string();
}

PictureOutput pictureOutput(const ros::NodeHandle& node, const std::string& topic,
                            const PictureTransport& transport) {
  if (transport.compressed) return PngOutput(node, topic, transport.queue_size);
  return CameraOutput(node, topic, transport.queue_size);
}

}  // namespace sunlit::ros_interface
