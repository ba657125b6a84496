#include "ros/render/camera_output.h"

#include <image_transport/camera_common.h>

#include "ros/conversions/images.h"

namespace sunlit::ros_interface {

namespace {

image_transport::CameraPublisher advertised(const ros::NodeHandle& node, const std::string& topic,
                                            std::uint32_t queue_size, const CameraSubscribers& of) {
  using ImageLink = image_transport::SingleSubscriberPublisher;
  using InfoLink = ros::SingleSubscriberPublisher;
  return image_transport::ImageTransport(node).advertiseCamera(
      topic, queue_size, of.images.joining<ImageLink>(), of.images.leaving<ImageLink>(),
      of.infos.joining<InfoLink>(), of.infos.leaving<InfoLink>());
}

}  // namespace

const sensor_msgs::ImagePtr& OutgoingPicture::raw() {
  if (!raw_) raw_ = toImageMessage(picture_, header_);
  return raw_;
}

const sensor_msgs::CompressedImagePtr& OutgoingPicture::png() {
  if (!png_) png_ = toPngMessage(picture_, header_);
  return png_;
}

CameraOutput::CameraOutput(const ros::NodeHandle& node, const std::string& topic, std::uint32_t queue_size)
    : publisher_(advertised(node, topic, queue_size, subscribers_)) {}

void CameraOutput::publish(OutgoingPicture* picture, const sensor_msgs::CameraInfo& info) const {
  publisher_.publish(picture->raw(), boost::make_shared<sensor_msgs::CameraInfo>(info));
}

void CameraOutput::publish(const image::DepthImage& depth, const sensor_msgs::CameraInfo& info) const {
  publisher_.publish(toImageMessage(depth, info.header), boost::make_shared<sensor_msgs::CameraInfo>(info));
}

std::string CameraOutput::lonelyTopic(const CameraAudience& wanted) const {
  if (!subscribers_.images.are(wanted.images)) return publisher_.getTopic();
  if (!subscribers_.infos.are(wanted.infos)) return publisher_.getInfoTopic();
  return std::string();
}

PngOutput::PngOutput(ros::NodeHandle node, const std::string& topic, std::uint32_t queue_size)
    : images_(HeardTopic::of<sensor_msgs::CompressedImage>(node, topic + "/compressed", queue_size)),
      infos_(HeardTopic::of<sensor_msgs::CameraInfo>(node, image_transport::getCameraInfoTopic(topic),
                                                     queue_size)) {}

void PngOutput::publish(OutgoingPicture* picture, const sensor_msgs::CameraInfo& info) const {
  // By what is connected now: `subscribers` hears of it only once callbacks are served.
  if (images_.publisher.getNumSubscribers() > 0) images_.publisher.publish(picture->png());
  infos_.publisher.publish(info);
}

std::string PngOutput::lonelyTopic(const CameraAudience& wanted) const {
  const std::string lonely = images_.ifLonely(wanted.images);
  return lonely.empty() ? infos_.ifLonely(wanted.infos) : lonely;
}

PictureOutput pictureOutput(const ros::NodeHandle& node, const std::string& topic,
                            const PictureTransport& transport) {
  if (transport.compressed) return PngOutput(node, topic, transport.queue_size);
  return CameraOutput(node, topic, transport.queue_size);
}

}  // namespace sunlit::ros_interface
