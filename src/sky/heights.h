/// Heights of tables, closer near the ground: index = √(altitude / top) · (count − 1).
#pragma once

#include <algorithm>
#include <cmath>

#include "medium.h"
#include "table_place.h"

namespace sunlit::sky {

inline double heightOf(int index, int count) {
  const double x = static_cast<double>(index) / (count - 1);
  return kAtmosphereHeight_km * x * x;
}

/// √(altitude / top), 0 … 1.
inline double heightRoot(double altitude_km) {
  return std::sqrt(std::clamp(altitude_km / kAtmosphereHeight_km, 0.0, 1.0));
}

inline TablePlace heightPlace(double root, int count) {
  return placeAt(static_cast<float>(root * (count - 1)), count);
}

}  // namespace sunlit::sky
