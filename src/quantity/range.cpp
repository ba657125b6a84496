#include "sunlit/quantity/range.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace sunlit {

bool Range::contains(double value) const {
  if (!std::isfinite(value)) return false;
  return (without_low ? value > low : value >= low) && (without_high ? value < high : value <= high);
}

std::string Range::words() const {
  const bool has_low = std::isfinite(low);
  const bool has_high = std::isfinite(high);
  const std::string to = (without_high ? "less than " : "") + textOf(high);
  if (has_low && has_high)
    return (without_low ? "above " : "from ") + textOf(low) + (without_low ? " and up to " : " to ") + to;
  if (has_low) return (without_low ? "above " : "at least ") + textOf(low);
  if (has_high) return (without_high ? "" : "at most ") + to;
  return "a finite number";
}

std::string Range::symbols() const {
  const bool has_low = std::isfinite(low);
  const bool has_high = std::isfinite(high);
  if (has_low && has_high)
    return (without_low ? "> " : "") + textOf(low) + " … " + (without_high ? "< " : "") + textOf(high);
  if (has_low) return (without_low ? "> " : "≥ ") + textOf(low);
  if (has_high) return (without_high ? "< " : "≤ ") + textOf(high);
  return "";
}

std::string textOf(double number, int digits) {
  // The sign of a NaN means nothing and depends on who made it.
  if (std::isnan(number)) return "nan";
  std::ostringstream text;
  text.precision(digits);
  text << number;
  return text.str();
}

std::string refusal(const std::string& key, const std::string& value, const std::string& allowed) {
  return key + " is " + value + ", but must be " + allowed;
}

void refuse(const std::string& key, const std::string& value, const std::string& allowed) {
  throw std::invalid_argument(refusal(key, value, allowed));
}

void require(const std::string& key, double value, const Range& range, const std::string& unit) {
  if (!range.contains(value)) refuse(key, textOf(value), range.words() + (unit.empty() ? "" : " " + unit));
}

}  // namespace sunlit
