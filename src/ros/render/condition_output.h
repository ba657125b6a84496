/// What leaves the node once per pose and condition: the image and how it was taken.
#pragma once

#include <ros/node_handle.h>

#include <Eigen/Geometry>
#include <string>
#include <variant>

#include "ros/render/camera_output.h"
#include "ros/render/options.h"
#include "ros/render/sky_moments.h"
#include "sunlit/image/calibration.h"
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

/// Of all that leaves the node.
struct OutputOptions {
  image::Calibration camera;
  CameraFrames frames;
  std::uint32_t queue_size = 10;  ///< messages kept for a subscriber that is slow to read
  bool compressed = false;        ///< pictures in PNG
  bool publish_tf = true;
  bool follows_tf = false;  ///< others say on TF where frames.camera is
};

/// Publishes camera/image_raw (or camera/image_raw/compressed), camera/camera_info and camera/capture of one
/// condition.
class ConditionOutput {
 public:
  ConditionOutput(const ros::NodeHandle& node, const OutputOptions& options);

  void publish(const Photograph& photograph, const SkyMoment& sky) const;
  /// The first topic with too few subscribers; empty if there is none.
  std::string lonelyTopic(const WantedSubscribers& wanted) const;

 private:
  OutputOptions options_;
  std::variant<CameraOutput, PngOutput> images_;
  ros::Publisher capture_;
};

}  // namespace sunlit::ros_interface
