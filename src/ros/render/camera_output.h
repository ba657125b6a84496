/// Images of a camera with how they were taken, raw or packed.
#pragma once

#include <image_transport/image_transport.h>
#include <ros/node_handle.h>
#include <sensor_msgs/CompressedImage.h>

#include <string>
#include <variant>

#include "ros/render/subscribers.h"
#include "sunlit/image/images.h"

namespace sunlit::ros_interface {

/// Who listens to the topics of a camera. A CameraPublisher only tells the greater of the two numbers.
struct CameraSubscribers {
  Subscribers images, infos;
};

/// Who shall.
struct CameraAudience {
  Audience images;
  Audience infos;
};

/// A picture on its way to several topics: each of its messages is made when first asked for, and once.
class OutgoingPicture {
 public:
  /// `picture` outlives this.
  OutgoingPicture(const image::Rgb8Image& picture, const std_msgs::Header& header)
      : picture_(picture), header_(header) {}
  const sensor_msgs::ImagePtr& raw();
  const sensor_msgs::CompressedImagePtr& png();

 private:
  const image::Rgb8Image& picture_;
  std_msgs::Header header_;
  sensor_msgs::ImagePtr raw_;
  sensor_msgs::CompressedImagePtr png_;
};

/// `topic` by an image_transport::CameraPublisher, with camera_info beside it.
class CameraOutput {
 public:
  /// `queue_size` messages are kept for a subscriber that is slow to read.
  CameraOutput(const ros::NodeHandle& node, const std::string& topic, std::uint32_t queue_size);

  void publish(OutgoingPicture* picture, const sensor_msgs::CameraInfo& info) const;
  void publish(const image::DepthImage& depth, const sensor_msgs::CameraInfo& info) const;
  /// Whether anybody listens to either.
  bool isHeard() const { return subscribers_.images.are({1, {}}) || subscribers_.infos.are({1, {}}); }
  /// The first topic with too few subscribers; empty if there is none.
  std::string lonelyTopic(const CameraAudience& wanted) const;

 private:
  CameraSubscribers subscribers_;
  image_transport::CameraPublisher publisher_;
};

/// `topic`/compressed in PNG, without loss and without a plug-in of image_transport, and camera_info beside
/// `topic`.
class PngOutput {
 public:
  PngOutput(ros::NodeHandle node, const std::string& topic, std::uint32_t queue_size);

  /// The picture only where somebody is there to get it: PNG takes its time.
  void publish(OutgoingPicture* picture, const sensor_msgs::CameraInfo& info) const;
  bool isHeard() const { return images_.subscribers.are({1, {}}) || infos_.subscribers.are({1, {}}); }
  std::string lonelyTopic(const CameraAudience& wanted) const;

 private:
  HeardTopic images_;
  HeardTopic infos_;
};

using PictureOutput = std::variant<CameraOutput, PngOutput>;

struct PictureTransport {
  std::uint32_t queue_size = 10;
  bool compressed = false;
};

PictureOutput pictureOutput(const ros::NodeHandle& node, const std::string& topic,
                            const PictureTransport& transport);

}  // namespace sunlit::ros_interface
