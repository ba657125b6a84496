/// What the node is doing, for people and programs that watch it.
#pragma once

#include <ros/node_handle.h>

#include <chrono>
#include <limits>
#include <string>

#include "sunlit/Activity.h"

namespace sunlit::ros_interface {

/// How far an activity is.
struct ActivityShare {
  double share = std::numeric_limits<double>::quiet_NaN();         ///< 0 … 1; NaN: unknown
  double seconds_left = std::numeric_limits<double>::quiet_NaN();  ///< NaN: unknown
};

/// Publishes ~activity, latched: each change at once, the same activity going on every second.
class ActivityOutput {
 public:
  explicit ActivityOutput(ros::NodeHandle private_node);
  void say(const std::string& doing, const std::string& detail = "", const ActivityShare& share = {});

  /// What was said last.
  const Activity& latest() const { return latest_; }

 private:
  using Clock = std::chrono::steady_clock;
  ros::Publisher publisher_;
  Activity latest_;
  Clock::time_point said_;
};

}  // namespace sunlit::ros_interface
