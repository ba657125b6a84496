/// Who else sends a frame on TF that is this node's.
#pragma once

#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <tf2_msgs/TFMessage.h>

#include <string>

namespace sunlit::ros_interface {

/// A frame of two senders is now where the one says, now where the other does, and TF tells nobody.
class FrameWatch {
 public:
  /// Of the frame that this node sends below `parent`. Listens until someone else sends it, too, and then
  /// warns of it, once, with `advice`.
  FrameWatch(ros::NodeHandle node, std::string frame, std::string parent, std::string advice);
  FrameWatch(const FrameWatch&) = delete;
  FrameWatch& operator=(const FrameWatch&) = delete;

 private:
  void listen(const ros::MessageEvent<const tf2_msgs::TFMessage>& event);

  const std::string frame_, parent_, advice_;
  ros::Subscriber moving_, standing_;
};

}  // namespace sunlit::ros_interface
