/// A time of the day, as people type it and as conditions are called after it.
#pragma once

#include <string>
#include <vector>

namespace sunlit::tools {

struct TimeOfDay {
  int second_of_day = 12 * 3600;  ///< 0 … 86399

  /// So many seconds after midnight, rounded, but never into the next day.
  static TimeOfDay at(double seconds);

  double hour() const { return second_of_day / 3600.0; }
  /// As experiments call their conditions: "h04", "h04_30".
  std::string name() const;
  /// "04:30", "04:30:10".
  std::string clock() const;
};

/// Of hours apart by commas, "4,12.5", rounded to seconds. Throws std::invalid_argument naming `option`, also
/// where two are the same.
std::vector<TimeOfDay> timesOf(const std::string& option, const std::string& text);

}  // namespace sunlit::tools
