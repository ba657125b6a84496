/// Which numbers are allowed, and the one wording in which bad input is refused.
#pragma once

#include <limits>
#include <string>

namespace sunlit {

/// Allowed values of a number, ends included unless made by one of the functions below. NaN and infinity
/// never are.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool without_low = false;
  bool without_high = false;

  static constexpr Range atLeast(double low) {
    return {low, std::numeric_limits<double>::infinity(), false, false};
  }
  static constexpr Range above(double low, double high = std::numeric_limits<double>::infinity()) {
    return {low, high, true, false};
  }
  static constexpr Range below(double low, double high) { return {low, high, false, true}; }

  bool contains(double value) const;
  /// For sentences: "from 1 to 10", "from 0 to less than 60", "at least 0", "above 0", "a finite number".
  std::string words() const;
  /// For tables: "1 … 10", "0 … < 60", "≥ 0", "> 0"; empty where every number is allowed.
  std::string symbols() const;
};

/// As a person would type it, with up to so many digits; "nan" whatever its sign.
std::string textOf(double number, int digits = 10);

/// "KEY is VALUE, but must be ALLOWED".
std::string refusal(const std::string& key, const std::string& value, const std::string& allowed);

/// Throws std::invalid_argument of that.
[[noreturn]] void refuse(const std::string& key, const std::string& value, const std::string& allowed);

/// Refuses `value` outside `range`: "turbidity is 11, but must be from 1 to 10", and the unit behind it.
void require(const std::string& key, double value, const Range& range, const std::string& unit = "");

}  // namespace sunlit
