#include "ros/render/optical_frame.h"

#include <ros/console.h>
#include <ros/init.h>
#include <tf2/exceptions.h>

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
    if (optical.sender != Sender::kNobody) continue;
    optical.sender = Sender::kThisNode;
    transforms.push_back(
        toTransform(optical.link_from_optical, headerOf(frames_.camera, ros::Time::now()), optical.frame));
  }
  // A topic that was advertised after the shutdown is none, and to publish on it would end the process.
  if (!transforms.empty() && !ros::isShuttingDown()) broadcaster_.sendTransform(transforms);
}

void OpticalFrames::publishWhereMissing(const tf2_ros::Buffer& tf) {
  for (Optical& optical : opticals_) {
    if (!optical.is_settled) look(tf, optical);
  }
  if (!looked_since_) looked_since_ = Clock::now();
  if (Clock::now() - *looked_since_ >= kPatience) publish();
}

void OpticalFrames::look(const tf2_ros::Buffer& tf, Optical& optical) const {
  std::string parent;
  if (!tf._getParent(optical.frame, ros::Time(0), parent)) return;
  if (optical.sender == Sender::kThisNode) {
    if (!isContested(tf, optical, parent)) return;
    optical.is_settled = true;
    ROS_WARN(
        "Others send the frame %s too, below %s on TF, and this node, which had heard of none, below %s: a "
        "frame has one parent and one place. With publish_tf: false it is left to them",
        optical.frame.c_str(), parent.c_str(), frames_.camera.c_str());
    return;
  }
  if (optical.sender == Sender::kNobody) {
    optical.sender = Sender::kOthers;
    optical.found = Clock::now();
    ROS_INFO("TF has the frame %s below %s: it is left to whoever sends it", optical.frame.c_str(),
             parent.c_str());
  }
  compare(tf, optical, parent);
}

bool OpticalFrames::isContested(const tf2_ros::Buffer& tf, const Optical& optical,
                                const std::string& parent) const {
  try {
    return parent != frames_.camera || !isInPlace(tf, optical);
  } catch (const tf2::TransformException&) {  // no number
    return true;
  }
}

void OpticalFrames::compare(const tf2_ros::Buffer& tf, Optical& optical, const std::string& parent) const {
  try {
    optical.is_settled = isInPlace(tf, optical);
    if (optical.is_settled) return;
    ROS_WARN(
        "The frame %s on TF is not where pictures are taken from, which is %s%s, with z forward, x right and "
        "y "
        "down: give another camera/follow_frame, or another name as %s",
        optical.frame.c_str(), optical.beside.c_str(), frames_.camera.c_str(), optical.row.c_str());
  } catch (const tf2::TransformException& error) {
    if (Clock::now() - optical.found < kPatience) return;  // what lies between may be heard a moment later
    ROS_WARN(
        "The frame %s, on TF below %s, is not connected with %s, so that TF cannot tell where pictures are "
        "taken from: give another camera/follow_frame, or another name as %s (%s)",
        optical.frame.c_str(), parent.c_str(), frames_.camera.c_str(), optical.row.c_str(), error.what());
  }
  optical.is_settled = true;
}

bool OpticalFrames::isInPlace(const tf2_ros::Buffer& tf, const Optical& optical) const {
  constexpr double kAgrees = 1e-3;  // rad and m: less than what calibrations are good for
  return lookUp(tf, frames_.camera, optical.frame, ros::Time(0))
      .parent_from_child.isApprox(optical.link_from_optical, kAgrees);
}

}  // namespace sunlit::ros_interface
