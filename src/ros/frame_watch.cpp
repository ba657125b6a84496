#include "ros/frame_watch.h"

#include <ros/console.h>
#include <ros/this_node.h>

#include <algorithm>
#include <utility>

#include "sunlit/ros/frame_names.h"
#include "sunlit/ros/topic_names.h"

namespace sunlit::ros_interface {

FrameWatch::FrameWatch(ros::NodeHandle node, std::string frame, std::string parent, std::string advice)
    : frame_(std::move(frame)), parent_(std::move(parent)), advice_(std::move(advice)) {
  constexpr std::uint32_t kQueueSize = 100;  // whoever sends a frame sends it again
  using Event = ros::MessageEvent<const tf2_msgs::TFMessage>;
  const boost::function<void(const Event&)> heard = [this](const Event& event) { listen(event); };
  moving_ = node.subscribe<tf2_msgs::TFMessage, const Event&>(topics::kTf, kQueueSize, heard);
  standing_ = node.subscribe<tf2_msgs::TFMessage, const Event&>(topics::kTfStatic, kQueueSize, heard);
}

void FrameWatch::listen(const ros::MessageEvent<const tf2_msgs::TFMessage>& event) {
  const std::string& sender = event.getPublisherName();
  if (sender == ros::this_node::getName()) return;
  const auto& transforms = event.getMessage()->transforms;
  const auto found = std::find_if(transforms.begin(), transforms.end(), [&](const auto& transform) {
    return withoutSlash(transform.child_frame_id) == frame_;
  });
  if (found == transforms.end() || !moving_) return;
  ROS_WARN(
      "%s sends the frame %s below %s on TF, and so does this node, below %s: where it is changes with "
      "who spoke last. %s",
      sender.c_str(), frame_.c_str(), found->header.frame_id.c_str(), parent_.c_str(), advice_.c_str());
  moving_.shutdown();
  standing_.shutdown();
}

}  // namespace sunlit::ros_interface
