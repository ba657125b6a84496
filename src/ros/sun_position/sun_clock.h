/// The time by which one sun moves.
#pragma once

#include <ros/time.h>

#include <optional>

#include "sunlit/quantity/instant.h"

namespace sunlit::ros_interface {

/// date_time + rate · (ROS time − start). It keeps no history: where ROS time stands still, so does the sun,
/// and where it jumps back, so does the sun.
class SunClock {
 public:
  SunClock(const Instant& date_time, double rate) : date_time_(date_time), rate_(rate) {}

  /// The sun's time at the ROS time `now`. The first valid `now` is the start; until then (ROS time 0: nobody
  /// has published /clock yet) it is date_time. Held at the first and last supported year; see atLimit().
  Instant at(const ros::Time& now);

  /// Whether the last at() was held at a limit.
  bool atLimit() const { return at_limit_; }
  double rate() const { return rate_; }

 private:
  Instant date_time_;
  double rate_;
  std::optional<ros::Time> start_;
  bool at_limit_ = false;
};

}  // namespace sunlit::ros_interface
