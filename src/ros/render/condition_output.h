/// What leaves the node once per pose and condition: the image and how it was taken.
#pragma once

#include <image_transport/image_transport.h>
#include <ros/node_handle.h>

#include <Eigen/Geometry>
#include <string>

#include "ros/render/options.h"
#include "ros/render/sky_moments.h"
#include "sunlit/image/camera.h"
#include "sunlit/image/images.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::ros_interface {

/// One developed image and what it was taken of.
struct Photograph {
  int pose_index = 0;
  ros::Time stamp;
  double ev100 = 0.0;
  image::Rgb8Image picture;
};

/// The sky that it was taken under.
struct SkyMoment {
  const SkyBodies& bodies;
  const sky::Daylight& light;
};

/// Publishes camera/image_raw, camera/camera_info and camera/capture of one condition.
class ConditionOutput {
 public:
  /// `queue_size` messages are kept for a subscriber that is slow to read.
  ConditionOutput(const ros::NodeHandle& node, const image::PinholeCamera& camera, std::uint32_t queue_size);

  void publish(const Photograph& photograph, const SkyMoment& sky) const;
  /// The first topic with too few subscribers; empty if there is none.
  std::string lonelyTopic(const WantedSubscribers& wanted) const;

 private:
  image::PinholeCamera camera_;
  image_transport::ImageTransport transport_;
  // The two halves of an image_transport::CameraPublisher, apart, so that the subscribers of each can be
  // counted.
  image_transport::Publisher image_;
  ros::Publisher camera_info_;
  ros::Publisher capture_;
};

}  // namespace sunlit::ros_interface
