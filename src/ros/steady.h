/// What goes by the steady clock, since ROS time may stand still just when there is something to tell.
#pragma once

#include <ros/time.h>

#include <map>
#include <string>

namespace sunlit::ros_interface {

/// ROS_*_THROTTLE by the steady clock, and for each thing by itself.
class Throttle {
 public:
  explicit Throttle(double period_s) : period_s_(period_s) {}

  /// Whether it is time to speak of `what`: for the first time, or `period_s` after the last.
  bool isTime(const std::string& what = "", ros::SteadyTime now = ros::SteadyTime::now()) {
    const auto [last, is_first] = spoken_.emplace(what, now);
    if (!is_first && (now - last->second).toSec() < period_s_) return false;
    last->second = now;
    return true;
  }

 private:
  double period_s_;
  std::map<std::string, ros::SteadyTime> spoken_;
};

/// Tells for how long ROS time has stood still.
class ClockWatch {
 public:
  /// s, between those calls that were told of the same ROS time `now` without a break.
  double standsFor(const ros::Time& now, ros::SteadyTime steady = ros::SteadyTime::now()) {
    if (since_.isZero() || now != seen_) since_ = steady;
    seen_ = now;
    return (steady - since_).toSec();
  }

 private:
  ros::Time seen_;
  ros::SteadyTime since_;
};

}  // namespace sunlit::ros_interface
