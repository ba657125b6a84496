/// Civil date and time as people type it, and an exact instant on the UT time line.
#pragma once

#include <cstdint>
#include <vector>

#include "sunlit/quantity/field.h"

namespace sunlit {

/// A date and clock time in a fixed time zone, as in the paper's Table 1. Proleptic: Gregorian from
/// 15 October 1582, Julian until 4 October 1582; astronomical years (0 is 1 BC). The ten days between do not
/// exist.
struct CivilDateTime {
  int year = 2024;
  int month = 7;
  int day = 1;
  int hour = 12;  ///< 24 too, with minute 0 and second 0: the end of the day
  int minute = 0;
  double second = 0.0;
  double timezone = 0.0;
};

constexpr Range kYears{-2000, 6000};

inline std::vector<Field> fieldsOf(CivilDateTime& civil) {
  return {{"year", &civil.year, "", kYears, "Julian calendar until 4 October 1582; year 0 is 1 BC"},
          {"month", &civil.month, "", {1, 12}, "of the year"},
          {"day", &civil.day, "", {1, 31}, "of the month, and not beyond its last"},
          {"hour", &civil.hour, "h", {0, 23}, "of the day"},
          {"minute", &civil.minute, "min", {0, 59}, "of the hour"},
          {"second", &civil.second, "s", Range::below(0, 60), "of the minute"},
          {"timezone", &civil.timezone, "h", {-18, 18}, "east of UTC; there is no daylight saving"}};
}

/// A point in time on the UTC line, exact to 1 ns over all supported years: a whole Julian day number and the
/// nanoseconds since that day's noon, since one double of a Julian date resolves only 40 µs.
class Instant {
 public:
  static constexpr std::int64_t kNanosecondsPerDay = 86400LL * 1000000000LL;

  /// 2000-01-01 12:00 UTC, JD 2451545.0.
  constexpr Instant() = default;
  /// Any `nanoseconds`; carried into whole days.
  constexpr Instant(std::int64_t julian_day, std::int64_t nanoseconds)
      : day_(julian_day + floorDays(nanoseconds)),
        nanoseconds_(nanoseconds - floorDays(nanoseconds) * kNanosecondsPerDay) {}

  constexpr std::int64_t julianDay() const { return day_; }                 ///< of the noon at or before
  constexpr std::int64_t nanosecondsOfDay() const { return nanoseconds_; }  ///< since that noon, [0, 1 day)
  constexpr double dayFraction() const { return static_cast<double>(nanoseconds_) / kNanosecondsPerDay; }
  /// One double: resolves about 40 µs.
  constexpr double julianDate() const { return static_cast<double>(day_) + dayFraction(); }

  constexpr Instant plusNanoseconds(std::int64_t ns) const { return Instant(day_, nanoseconds_ + ns); }
  constexpr Instant plusSeconds(double s) const {
    const auto whole_days = static_cast<std::int64_t>(s / 86400.0);
    const double rest_s = s - static_cast<double>(whole_days) * 86400.0;
    return Instant(day_ + whole_days,
                   nanoseconds_ + static_cast<std::int64_t>(rest_s * 1e9 + (rest_s < 0 ? -0.5 : 0.5)));
  }
  /// this − other, s.
  constexpr double secondsSince(const Instant& other) const {
    return static_cast<double>(day_ - other.day_) * 86400.0 +
           static_cast<double>(nanoseconds_ - other.nanoseconds_) * 1e-9;
  }
  constexpr bool operator==(const Instant& o) const {
    return day_ == o.day_ && nanoseconds_ == o.nanoseconds_;
  }
  constexpr bool operator!=(const Instant& o) const { return !(*this == o); }
  constexpr bool operator<(const Instant& o) const {
    return day_ != o.day_ ? day_ < o.day_ : nanoseconds_ < o.nanoseconds_;
  }

 private:
  static constexpr std::int64_t floorDays(std::int64_t ns) {
    return ns / kNanosecondsPerDay - (ns % kNanosecondsPerDay < 0 ? 1 : 0);
  }
  std::int64_t day_ = 2451545;
  std::int64_t nanoseconds_ = 0;
};

}  // namespace sunlit
