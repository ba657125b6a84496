/// The time by which one sun moves.
#pragma once

#include <ros/time.h>

#include <optional>

#include "sunlit/quantity/instant.h"
#include "sunlit/quantity/range.h"

namespace sunlit::ros_interface {

/// Of a clock: 1e8 is three years of sun time a second; every step stays well inside an Instant.
constexpr Range kRates{-1e8, 1e8};

/// date_time + rate · (ROS time − start). It keeps no history: where ROS time stands still, so does the sun,
/// and where it jumps back, so does the sun.
class SunClock {
 public:
  /// `start`: nothing: the first valid `now`.
  SunClock(const Instant& date_time, double rate, const std::optional<ros::Time>& start = std::nullopt)
      : date_time_(date_time), rate_(rate), start_(start) {}

  /// The sun's time at the ROS time `now`; date_time while that is 0: nobody has published /clock yet. Held
  /// at the first and last supported year; see atLimit().
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
