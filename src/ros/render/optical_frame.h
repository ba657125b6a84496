/// Where the optical frame of the camera is, on /tf_static.
#pragma once

#include <tf2_ros/buffer.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <chrono>
#include <optional>

#include "ros/render/camera_frames.h"

namespace sunlit::ros_interface {

/// Says once where frames.optical is below frames.camera: z forward, x right, y down.
class OpticalFrame {
 public:
  explicit OpticalFrame(const CameraFrames& frames) : frames_(frames) {}

  void publish();
  /// For a tree that is others', where frames.camera is known already: a frame has one parent, so this
  /// publishes only what `tf` still does not know a moment after the first call, and tells of what it does.
  void publishWhereMissing(const tf2_ros::Buffer& tf);

 private:
  void compare(const tf2_ros::Buffer& tf) const;

  using Clock = std::chrono::steady_clock;
  CameraFrames frames_;
  tf2_ros::StaticTransformBroadcaster broadcaster_;
  std::optional<Clock::time_point> looked_since_;
  bool is_settled_ = false;  ///< it is published, or others have it
};

}  // namespace sunlit::ros_interface
