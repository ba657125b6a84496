/// Where the optical frames of the camera are, on /tf_static.
#pragma once

#include <tf2_ros/buffer.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "ros/render/camera_frames.h"
#include "sunlit/image/stereo.h"

namespace sunlit::ros_interface {

/// Says once where frames.optical is below frames.camera: z forward, x right, y down; and
/// frames.right_optical where there is a `right` camera.
class OpticalFrames {
 public:
  OpticalFrames(const CameraFrames& frames, const std::optional<image::RightCamera>& right);

  void publish();
  /// For a tree that is others', where frames.camera is known already: a frame has one parent, so this
  /// publishes only what `tf` still does not know a moment after the first call, and tells of what it does.
  void publishWhereMissing(const tf2_ros::Buffer& tf);

 private:
  struct Optical {
    std::string frame, row;  ///< what it is called, and by which parameter
    std::string beside;      ///< what stands before frames.camera where that is not its place
    Eigen::Isometry3d link_from_optical;
    bool is_settled = false;  ///< it is published, or others have it
  };
  void compare(const tf2_ros::Buffer& tf, const Optical& optical) const;

  using Clock = std::chrono::steady_clock;
  CameraFrames frames_;
  std::vector<Optical> opticals_;
  tf2_ros::StaticTransformBroadcaster broadcaster_;
  std::optional<Clock::time_point> looked_since_;
};

}  // namespace sunlit::ros_interface
