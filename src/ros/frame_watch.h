/// Who else sends a frame on TF that is this node's.
#pragma once

#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <tf2_msgs/TFMessage.h>

#include <map>
#include <string>

namespace sunlit::ros_interface {

/// A frame of two senders is now where the one says, now where the other does, and TF tells nobody.
class FrameWatch {
 public:
  /// Listens from now on, and warns of each frame once, with `advice`. `parents` has the frames that this
  /// node sends, each with that which it sends it below.
  FrameWatch(ros::NodeHandle node, std::map<std::string, std::string> parents, std::string advice);
  FrameWatch(const FrameWatch&) = delete;
  FrameWatch& operator=(const FrameWatch&) = delete;

 private:
  void listen(const ros::MessageEvent<const tf2_msgs::TFMessage>& event);

  std::map<std::string, std::string> parents_;  ///< of frames that nobody else has sent yet
  std::string advice_;
  ros::Subscriber moving_, standing_;
};

}  // namespace sunlit::ros_interface
