/// Degrees as the report of SPA writes its equations.
#pragma once

#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit::astronomy {

/// `deg` brought into [0, 360).
inline double inTurn(double deg) {
  const double in_turn = deg - 360.0 * std::floor(deg / 360.0);
  return in_turn < 360.0 ? in_turn : 0.0;  // rounding may carry a tiny negative angle up to a whole turn
}

/// `deg` brought into (−180, 180].
inline double inHalfTurns(double deg) {
  return 180.0 - inTurn(180.0 - deg);
}

inline double sinDeg(double deg) {
  return std::sin(deg * kRadPerDeg);
}
inline double cosDeg(double deg) {
  return std::cos(deg * kRadPerDeg);
}

}  // namespace sunlit::astronomy
