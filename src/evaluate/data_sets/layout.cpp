#include "evaluate/data_sets/layout.h"

#include <cstdio>

namespace sunlit::evaluate {

std::string fixedText(double number, int digits) {
  char text[400];  // of the largest double, too
  std::snprintf(text, sizeof text, "%.*f", digits, number);
  const std::string written = text;
  const bool is_minus_zero = written[0] == '-' && written.find_first_not_of("-0.") == std::string::npos;
  return is_minus_zero ? written.substr(1) : written;
}

std::string fixedTexts(const std::vector<double>& numbers, const std::string& between, int digits) {
  std::string line;
  for (const double number : numbers) line += (line.empty() ? "" : between) + fixedText(number, digits);
  return line;
}

Eigen::Quaterniond turnOf(const Eigen::Isometry3d& pose) {
  Eigen::Quaterniond turn(pose.linear());
  turn.normalize();
  if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
  return turn;
}

}  // namespace sunlit::evaluate
