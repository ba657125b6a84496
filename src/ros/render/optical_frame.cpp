#include "ros/render/optical_frame.h"

#include <ros/console.h>
#include <tf2/exceptions.h>

#include "ros/conversions/geometry.h"
#include "ros/render/tf_lookup.h"
#include "sunlit/quantity/frames.h"

namespace sunlit::ros_interface {

namespace {

/// How late the static part of a tree may be heard behind its moving part; each has a topic of its own.
constexpr std::chrono::seconds kPatience(1);

}  // namespace

void OpticalFrame::publish() {
  is_settled_ = true;
  broadcaster_.sendTransform(toTransform(Eigen::Isometry3d(linkFromOptical()),
                                         headerOf(frames_.camera, ros::Time::now()), frames_.optical));
}

void OpticalFrame::publishWhereMissing(const tf2_ros::Buffer& tf) {
  if (is_settled_) return;
  std::string parent;
  if (tf._getParent(frames_.optical, ros::Time(0), parent)) {
    is_settled_ = true;
    ROS_INFO("TF has the frame %s below %s: it is left to whoever sends it", frames_.optical.c_str(),
             parent.c_str());
    return compare(tf);
  }
  if (!looked_since_) looked_since_ = Clock::now();
  if (Clock::now() - *looked_since_ >= kPatience) publish();
}

void OpticalFrame::compare(const tf2_ros::Buffer& tf) const {
  constexpr double kAgrees = 1e-3;  // rad and m: less than what calibrations are good for
  try {
    const Eigen::Isometry3d found =
        lookUp(tf, frames_.camera, frames_.optical, ros::Time(0)).parent_from_child;
    if (found.isApprox(Eigen::Isometry3d(linkFromOptical()), kAgrees)) return;
  } catch (const tf2::TransformException&) {  // not of one tree
  }
  ROS_WARN(
      "The frame %s on TF is not where pictures are taken from, which is %s, with z forward, x right and y "
      "down: give another camera/follow_frame, or another name as frames/optical",
      frames_.optical.c_str(), frames_.camera.c_str());
}

}  // namespace sunlit::ros_interface
