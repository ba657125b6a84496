#include "ros/sun_position/sun_clock.h"

#include <algorithm>

#include "sunlit/astronomy/civil_time.h"

namespace sunlit::ros_interface {

Instant SunClock::at(const ros::Time& now) {
  at_limit_ = false;
  if (now.isZero()) return date_time_;
  if (!start_) start_ = now;
  const Instant first = astronomy::midnightOf({static_cast<int>(kYears.low), 1, 1, 0.0});
  const Instant last = astronomy::midnightOf({static_cast<int>(kYears.high), 12, 31, 0.0});
  const double elapsed_s = rate_ * (now - *start_).toSec();
  at_limit_ = elapsed_s < first.secondsSince(date_time_) || elapsed_s > last.secondsSince(date_time_);
  if (!at_limit_) return date_time_.plusSeconds(elapsed_s);
  return elapsed_s < 0.0 ? first : last;
}

}  // namespace sunlit::ros_interface
