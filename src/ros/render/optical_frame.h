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
  /// publishes only what `tf` still does not know a moment after the first call, tells of what it does, and
  /// warns once of what others send later, or elsewhere. To be called again and again.
  void publishWhereMissing(const tf2_ros::Buffer& tf);

 private:
  using Clock = std::chrono::steady_clock;
  enum class Sender { kNobody, kThisNode, kOthers };
  struct Optical {
    std::string frame, row;  ///< what it is called, and by which parameter
    std::string beside;      ///< what stands before frames.camera where that is not its place
    Eigen::Isometry3d link_from_optical;
    Sender sender = Sender::kNobody;
    Clock::time_point found = {};  ///< when others' was
    bool is_settled = false;       ///< all is told of it
  };
  void look(const tf2_ros::Buffer& tf, Optical& optical) const;
  /// Whether others send one that is this node's, elsewhere. `parent`: by `tf`.
  bool isContested(const tf2_ros::Buffer& tf, const Optical& optical, const std::string& parent) const;
  /// Of one that is others'.
  void compare(const tf2_ros::Buffer& tf, Optical& optical, const std::string& parent) const;
  /// Throws tf2::TransformException where `tf` knows no way to it.
  bool isInPlace(const tf2_ros::Buffer& tf, const Optical& optical) const;

  CameraFrames frames_;
  std::vector<Optical> opticals_;
  tf2_ros::StaticTransformBroadcaster broadcaster_;
  std::optional<Clock::time_point> looked_since_;
};

}  // namespace sunlit::ros_interface
