/// What leaves the node once per pose and condition: the image and how it was taken.
#pragma once

#include <ros/node_handle.h>

#include <optional>
#include <string>

#include "ros/render/camera_output.h"
#include "ros/render/options.h"
#include "ros/render/output.h"
#include "ros/render/sky_moments.h"
#include "ros/render/stereo_output.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::ros_interface {

/// The sky that it was taken under.
struct SkyMoment {
  const SkyBodies& bodies;
  const sky::Daylight& light;
};

/// Publishes camera/image_raw (or camera/image_raw/compressed), camera/camera_info and camera/capture of one
/// condition, and what a StereoOutput does where there is a right camera.
class ConditionOutput {
 public:
  ConditionOutput(const ros::NodeHandle& node, const OutputOptions& options);

  void publish(const Photograph& photograph, const SkyMoment& sky) const;
  /// The first topic with too few subscribers; empty if there is none.
  std::string lonelyTopic(const WantedSubscribers& wanted) const;

 private:
  OutputOptions options_;
  PictureOutput images_;
  std::optional<StereoOutput> stereo_;
  HeardTopic capture_;
};

}  // namespace sunlit::ros_interface
