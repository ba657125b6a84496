#include "ros/sun_position/sun_clock.h"

#include <algorithm>

#include "ros/conversions/time.h"
#include "sunlit/astronomy/civil_time.h"

namespace sunlit::ros_interface {

Instant SunClock::at(const ros::Time& now) {
  at_limit_ = false;
  if (now.isZero()) return date_time_;
  if (!start_) start_ = now;
  // A date may be set, by its offset from UTC, to some hours before the first day or after the last one.
  constexpr double kLastOfDay_s = 86399.0;
  const Instant first_day = astronomy::midnightOf({static_cast<int>(kYears.low), 1, 1, 0.0});
  const Instant last_day = astronomy::midnightOf({static_cast<int>(kYears.high), 12, 31, 0.0});
  const double earliest_s = std::min(first_day.secondsSince(date_time_), 0.0);
  const double latest_s = std::max(last_day.secondsSince(date_time_) + kLastOfDay_s, 0.0);
  const double elapsed_s = rate_ * secondsFrom(*start_, now);
  at_limit_ = elapsed_s < earliest_s || elapsed_s > latest_s;
  return date_time_.plusSeconds(std::clamp(elapsed_s, earliest_s, latest_s));
}

}  // namespace sunlit::ros_interface
