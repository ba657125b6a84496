/// What a stereo camera adds to the topics of a condition.
#pragma once

#include <ros/node_handle.h>

#include <string>

#include "ros/render/camera_output.h"
#include "ros/render/output.h"

namespace sunlit::ros_interface {

/// Publishes camera/left and camera/right, each image_raw (or image_raw/compressed) and camera_info: where
/// stereo_image_proc looks for them in the namespace camera. The left ones are camera/image_raw and
/// camera/camera_info once more, and are only made for whoever listens.
class StereoOutput {
 public:
  /// `options.right` is there.
  StereoOutput(const ros::NodeHandle& node, const OutputOptions& options);

  /// With a right picture; `left` is its other one, of the left frame.
  void publish(const Photograph& photograph, OutgoingPicture* left) const;
  /// The first topic with too few subscribers; empty if there is none.
  std::string lonelyTopic(const Audience& left, const Audience& right) const;

 private:
  OutputOptions options_;
  PictureOutput left_, right_;
};

}  // namespace sunlit::ros_interface
