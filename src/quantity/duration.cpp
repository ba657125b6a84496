#include "sunlit/quantity/duration.h"

#include <cmath>
#include <cstdio>

namespace sunlit {

std::string textOfDuration(double seconds) {
  const long whole = std::lround(seconds);
  char text[48];
  if (whole < 60) {
    std::snprintf(text, sizeof text, "%ld s", whole);
  } else if (whole < 3600) {
    std::snprintf(text, sizeof text, "%ld min %02ld s", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%ld h %02ld min", whole / 3600, whole % 3600 / 60);
  }
  return text;
}

std::string textOfTimeLeft(double seconds) {
  return std::isnan(seconds) ? "" : ", " + textOfDuration(seconds) + " left";
}

}  // namespace sunlit
