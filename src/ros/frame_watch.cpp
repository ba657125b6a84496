#include "ros/frame_watch.h"

#include <ros/console.h>
#include <ros/this_node.h>

#include <utility>

#include "sunlit/ros/topic_names.h"

namespace sunlit::ros_interface {
namespace {

/// As TF itself reads names of those who still write a slash in front.
std::string withoutSlash(const std::string& frame) {
  return frame.empty() || frame.front() != '/' ? frame : frame.substr(1);
}

}  // namespace

FrameWatch::FrameWatch(ros::NodeHandle node, std::map<std::string, std::string> parents, std::string advice)
    : parents_(std::move(parents)), advice_(std::move(advice)) {
  constexpr std::uint32_t kQueueSize = 100;  // whoever sends a frame sends it again
  using Event = ros::MessageEvent<const tf2_msgs::TFMessage>;
  const boost::function<void(const Event&)> heard = [this](const Event& event) { listen(event); };
  moving_ = node.subscribe<tf2_msgs::TFMessage, const Event&>(topics::kTf, kQueueSize, heard);
  standing_ = node.subscribe<tf2_msgs::TFMessage, const Event&>(topics::kTfStatic, kQueueSize, heard);
}

void FrameWatch::listen(const ros::MessageEvent<const tf2_msgs::TFMessage>& event) {
  const std::string& sender = event.getPublisherName();
  if (sender == ros::this_node::getName()) return;
  for (const geometry_msgs::TransformStamped& transform : event.getMessage()->transforms) {
    const auto own = parents_.find(withoutSlash(transform.child_frame_id));
    if (own == parents_.end()) continue;
    ROS_WARN(
        "%s sends the frame %s below %s on TF, and so does this node, below %s: where it is changes with "
        "who spoke last. %s",
        sender.c_str(), own->first.c_str(), transform.header.frame_id.c_str(), own->second.c_str(),
        advice_.c_str());
    parents_.erase(own);
  }
}

}  // namespace sunlit::ros_interface
