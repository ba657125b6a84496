#include "ros/render/optical_frame.h"

#include <ros/console.h>
#include <ros/init.h>
#include <tf2/exceptions.h>

#include <algorithm>

#include "ros/conversions/geometry.h"
#include "ros/render/tf_lookup.h"
#include "sunlit/quantity/frames.h"
#include "sunlit/quantity/range.h"

namespace sunlit::ros_interface {

namespace {

/// How late the static part of a tree may be heard behind its moving part; each has a topic of its own.
constexpr std::chrono::seconds kPatience(1);

}  // namespace

OpticalFrames::OpticalFrames(const CameraFrames& frames, const std::optional<image::RightCamera>& right)
    : frames_(frames), opticals_{{frames.optical, "frames/optical", "", linkFromOptical()}} {
  if (!right) return;
  const double baseline_m = right->left_from_right.translation().norm();
  opticals_.push_back({frames.right_optical, "frames/right_optical",
                       textOf(baseline_m, 3) + " m to the right of ",
                       linkFromOptical() * right->left_from_right});
}

void OpticalFrames::publish() {
  std::vector<geometry_msgs::TransformStamped> transforms;
  for (Optical& optical : opticals_) {
    if (optical.is_settled) continue;
    optical.is_settled = true;
    transforms.push_back(
        toTransform(optical.link_from_optical, headerOf(frames_.camera, ros::Time::now()), optical.frame));
  }
  // A topic that was advertised after the shutdown is none, and to publish on it would end the process.
  if (!transforms.empty() && !ros::isShuttingDown()) broadcaster_.sendTransform(transforms);
}

void OpticalFrames::publishWhereMissing(const tf2_ros::Buffer& tf) {
  if (std::all_of(opticals_.begin(), opticals_.end(), [](const Optical& one) { return one.is_settled; }))
    return;
  for (Optical& optical : opticals_) {
    std::string parent;
    if (optical.is_settled || !tf._getParent(optical.frame, ros::Time(0), parent)) continue;
    optical.is_settled = true;
    ROS_INFO("TF has the frame %s below %s: it is left to whoever sends it", optical.frame.c_str(),
             parent.c_str());
    compare(tf, optical);
  }
  if (!looked_since_) looked_since_ = Clock::now();
  if (Clock::now() - *looked_since_ >= kPatience) publish();
}

void OpticalFrames::compare(const tf2_ros::Buffer& tf, const Optical& optical) const {
  constexpr double kAgrees = 1e-3;  // rad and m: less than what calibrations are good for
  try {
    const Eigen::Isometry3d found = lookUp(tf, frames_.camera, optical.frame, ros::Time(0)).parent_from_child;
    if (found.isApprox(optical.link_from_optical, kAgrees)) return;
  } catch (const tf2::TransformException&) {  // not of one tree
  }
  ROS_WARN(
      "The frame %s on TF is not where pictures are taken from, which is %s%s, with z forward, x right and y "
      "down: give another camera/follow_frame, or another name as %s",
      optical.frame.c_str(), optical.beside.c_str(), frames_.camera.c_str(), optical.row.c_str());
}

}  // namespace sunlit::ros_interface
