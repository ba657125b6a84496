/// Images of a camera with how they were taken, raw or packed.
#pragma once

#include <image_transport/image_transport.h>
#include <ros/node_handle.h>

#include <memory>
#include <string>
#include <variant>

#include "sunlit/image/images.h"

namespace sunlit::ros_interface {

/// How many subscribers the topics of a camera must have.
struct CameraSubscribers {
  int images = 0;
  int infos = 0;
};

/// `topic` by an image_transport::CameraPublisher, with camera_info beside it.
class CameraOutput {
 public:
  /// `queue_size` messages are kept for a subscriber that is slow to read.
  CameraOutput(const ros::NodeHandle& node, const std::string& topic, std::uint32_t queue_size);

  void publish(const image::Rgb8Image& picture, const sensor_msgs::CameraInfo& info) const;
  void publish(const image::DepthImage& depth, const sensor_msgs::CameraInfo& info) const;
  /// Whether anybody listens to either.
  bool isHeard() const { return counted_->images > 0 || counted_->infos > 0; }
  /// The first topic with too few subscribers; empty if there is none.
  std::string lonelyTopic(const CameraSubscribers& wanted) const;

 private:
  /// By whatever transport. A CameraPublisher only tells the greater of its two numbers.
  std::shared_ptr<CameraSubscribers> counted_;
  image_transport::CameraPublisher publisher_;
};

/// `topic`/compressed in PNG, without loss and without a plug-in of image_transport, and camera_info beside
/// `topic`.
class PngOutput {
 public:
  PngOutput(ros::NodeHandle node, const std::string& topic, std::uint32_t queue_size);

  void publish(const image::Rgb8Image& picture, const sensor_msgs::CameraInfo& info) const;
  bool isHeard() const { return images_.getNumSubscribers() > 0 || infos_.getNumSubscribers() > 0; }
  std::string lonelyTopic(const CameraSubscribers& wanted) const;

 private:
  ros::Publisher images_;
  ros::Publisher infos_;
};

using PictureOutput = std::variant<CameraOutput, PngOutput>;

struct PictureTransport {
  std::uint32_t queue_size = 10;
  bool compressed = false;
};

PictureOutput pictureOutput(const ros::NodeHandle& node, const std::string& topic,
                            const PictureTransport& transport);

}  // namespace sunlit::ros_interface
