#include "ros/conversions/time.h"

#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include "sunlit/astronomy/civil_time.h"

namespace sunlit::ros_interface {

namespace {

/// What the first and last local days of some time zones reach beyond kYears, in UTC: taken a day nearer.
CivilDateTime withinYears(CivilDateTime civil, int* days_off) {
  if (civil.year == static_cast<int>(kYears.low) - 1 && civil.month == 12 && civil.day == 31) {
    *days_off = -1;
    civil = {civil.year + 1, 1, 1, civil.hour, civil.minute, civil.second, civil.timezone};
  } else if (civil.year == static_cast<int>(kYears.high) + 1 && civil.month == 1 && civil.day == 1) {
    *days_off = 1;
    civil = {civil.year - 1, 12, 31, civil.hour, civil.minute, civil.second, civil.timezone};
  }
  return civil;
}

/// To 1 ms, so that no second is printed as 60.000.
Instant rounded(const Instant& instant) {
  constexpr std::int64_t kNanosecondsPerMillisecond = 1000000;
  const std::int64_t milliseconds =
      (instant.nanosecondsOfDay() + kNanosecondsPerMillisecond / 2) / kNanosecondsPerMillisecond;
  return Instant(instant.julianDay(), milliseconds * kNanosecondsPerMillisecond);
}

}  // namespace

std::string toUtc(const Instant& instant) {
  const CivilDateTime civil = astronomy::civilOf(rounded(instant), 0.0);
  char text[64];
  std::snprintf(text, sizeof(text), "%s%04d-%02d-%02dT%02d:%02d:%06.3fZ", civil.year < 0 ? "-" : "",
                civil.year < 0 ? -civil.year : civil.year, civil.month, civil.day, civil.hour, civil.minute,
                civil.second);
  return text;
}

std::optional<Instant> fromUtc(const std::string& utc) {
  if (utc.empty()) return std::nullopt;
  CivilDateTime civil;
  int length = 0;
  const int fields = std::sscanf(utc.c_str(), "%d-%2d-%2dT%2d:%2d:%lfZ%n", &civil.year, &civil.month,
                                 &civil.day, &civil.hour, &civil.minute, &civil.second, &length);
  if (fields != 6 || length != static_cast<int>(utc.size()))
    throw std::invalid_argument("utc is \"" + utc + "\", but must read like 2024-07-01T09:00:00.000Z");
  civil.timezone = 0.0;
  try {
    int days_off = 0;
    const Instant instant = astronomy::instantOf(withinYears(civil, &days_off));
    return instant.plusNanoseconds(days_off * Instant::kNanosecondsPerDay);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("utc is \"" + utc + "\": " + error.what());
  }
}

std::string textOfDate(const Instant& instant, double timezone) {
  constexpr double kSecondsPerHour = 3600.0;
  const CivilDateTime civil =
      astronomy::civilOf(rounded(instant.plusSeconds(timezone * kSecondsPerHour)), 0.0);
  const long minutes = std::lround(std::abs(timezone) * 60.0);
  char text[96];
  std::snprintf(text, sizeof(text), "%d-%02d-%02d %02d:%02d:%06.3f UTC%c%02ld:%02ld", civil.year, civil.month,
                civil.day, civil.hour, civil.minute, civil.second, timezone < 0.0 ? '-' : '+', minutes / 60,
                minutes % 60);
  return text;
}

std::string textOfStamp(const ros::Time& stamp) {
  std::ostringstream text;
  text << stamp;
  return text.str();
}

}  // namespace sunlit::ros_interface
