#include "sunlit/astronomy/limits.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace sunlit::astronomy {

void require(const Limits& limits, double value) {
  if (value >= limits.min && value <= limits.max) return;  // false for NaN
  std::ostringstream message;
  message.precision(10);
  message << limits.name << " is ";
  // The sign of a NaN means nothing and depends on who sent it.
  if (std::isnan(value)) {
    message << "nan";
  } else {
    message << value;
  }
  message << ", but must be from " << limits.min << " to " << limits.max;
  if (*limits.unit != '\0') message << " " << limits.unit;
  throw std::invalid_argument(message.str());
}

void require(const Site& site) {
  require(kLatitudeLimits, site.latitude.deg());
  require(kLongitudeLimits, site.longitude.deg());
  require(kElevationLimits, site.elevation_m);
}

void require(const Air& air) {
  require(kPressureLimits, air.pressure_hpa);
  require(kTemperatureLimits, air.temperature_c);
  require(kHorizonRefractionLimits, air.refraction_at_horizon.deg());
}

}  // namespace sunlit::astronomy
