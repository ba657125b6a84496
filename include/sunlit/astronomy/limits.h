/// What may be typed in for the sun: one home for every allowed range.
#pragma once

#include "sunlit/quantity/site.h"

namespace sunlit::astronomy {

/// The allowed values of one input, ends included, in the unit in which people type it.
struct Limits {
  const char* name;
  double min;
  double max;
  const char* unit;
};

inline constexpr Limits kYearLimits{"year", -2000, 6000, ""};
inline constexpr Limits kMonthLimits{"month", 1, 12, ""};
inline constexpr Limits kHourLimits{"hour", 0, 23, "h"};
inline constexpr Limits kMinuteLimits{"minute", 0, 59, "min"};
inline constexpr Limits kSecondLimits{"second", 0, 60, "s"};  ///< 60 itself is out
inline constexpr Limits kTimezoneLimits{"timezone", -18, 18, "h"};
/// 1e8 is three years of sun time a second; every step of the clock stays well inside an Instant.
inline constexpr Limits kRateLimits{"rate", -1e8, 1e8, "s/s"};
inline constexpr Limits kLatitudeLimits{"latitude", -90, 90, "deg"};
inline constexpr Limits kLongitudeLimits{"longitude", -180, 180, "deg"};
inline constexpr Limits kElevationLimits{"elevation", -500, 12000, "m"};
inline constexpr Limits kPressureLimits{"pressure", 0, 1200, "hPa"};
inline constexpr Limits kTemperatureLimits{"temperature", -100, 60, "deg C"};
inline constexpr Limits kHorizonRefractionLimits{"atmospheric_refraction", 0, 5, "deg"};
inline constexpr Limits kDeltaUt1Limits{"delta_ut1", -1, 1, "s"};
/// The published polynomials reach 56,000 s at the ends of the supported years.
inline constexpr Limits kDeltaTLimits{"delta_t", -100000, 100000, "s"};
inline constexpr Limits kSlopeLimits{"slope", -360, 360, "deg"};
inline constexpr Limits kAzmRotationLimits{"azm_rotation", -360, 360, "deg"};

/// Throws std::invalid_argument naming input, value and range unless `value` is a number inside `limits`.
void require(const Limits& limits, double value);

/// Throws as above for the first bad one of latitude, longitude and elevation.
void require(const Site& site);

/// Throws as above for the first bad one of pressure, temperature and atmospheric_refraction.
void require(const Air& air);

}  // namespace sunlit::astronomy
