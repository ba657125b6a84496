#include "tools/time_of_day.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "sunlit/quantity/columns.h"
#include "sunlit/quantity/field.h"

namespace sunlit::tools {

namespace {

constexpr int kSecondsPerDay = 24 * 3600;

}  // namespace

TimeOfDay TimeOfDay::at(double seconds) {
  return {std::min(static_cast<int>(std::lround(seconds)), kSecondsPerDay - 1)};
}

std::string TimeOfDay::name() const {
  const int h = second_of_day / 3600, m = second_of_day / 60 % 60, s = second_of_day % 60;
  char text[16];
  std::snprintf(text, sizeof text, s > 0 ? "h%02d_%02d_%02d" : m > 0 ? "h%02d_%02d" : "h%02d", h, m, s);
  return text;
}

std::string TimeOfDay::clock() const {
  const int h = second_of_day / 3600, m = second_of_day / 60 % 60, s = second_of_day % 60;
  char text[16];
  std::snprintf(text, sizeof text, s > 0 ? "%02d:%02d:%02d" : "%02d:%02d", h, m, s);
  return text;
}

std::vector<TimeOfDay> timesOf(const std::string& option, const std::string& text) {
  std::vector<TimeOfDay> times;
  for (const std::string& part : splitAtCommas(text)) {
    double hour = 0.0;
    Field{"hour", &hour, "h", Range::below(0, 24), ""}.setText(part, option);
    times.push_back(TimeOfDay::at(hour * 3600.0));
    const auto is_same = [&](const TimeOfDay& other) {
      return other.second_of_day == times.back().second_of_day;
    };
    if (std::count_if(times.begin(), times.end(), is_same) > 1)
      throw std::invalid_argument(option + " names " + times.back().name() + " twice");
  }
  return times;
}

}  // namespace sunlit::tools
