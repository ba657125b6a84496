/// Civil time in messages, and times in words. Pure functions.
#pragma once

#include <ros/time.h>

#include <cstdint>
#include <optional>
#include <string>

#include "sunlit/quantity/instant.h"

namespace sunlit::ros_interface {

/// "2024-07-01T09:00:00.000Z": ISO 8601 in UTC, rounded to 1 ms; "-1999-07-01T…" for years before 0. Calendar
/// as in CivilDateTime.
std::string toUtc(const Instant& instant);

/// What toUtc() writes of the days of kYears in any time zone, so up to a day beyond, with any number of
/// decimals; empty: nothing is known. Throws std::invalid_argument for anything else.
std::optional<Instant> fromUtc(const std::string& utc);

/// "2024-07-01 04:00:00.000 UTC+03:00", rounded to 1 ms; `timezone` in h east of UTC.
std::string textOfDate(const Instant& instant, double timezone);

/// From `a` to `b`, s, whatever lies between: their difference as ros::Duration throws beyond 68 years.
inline double secondsFrom(const ros::Time& a, const ros::Time& b) {
  return 1e-9 *
         static_cast<double>(static_cast<std::int64_t>(b.toNSec()) - static_cast<std::int64_t>(a.toNSec()));
}

/// "1719792000.000000000", s.
std::string textOfStamp(const ros::Time& stamp);

}  // namespace sunlit::ros_interface
