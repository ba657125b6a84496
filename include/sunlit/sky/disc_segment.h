/// A disc that a line cuts, as the horizon cuts sun and moon.
#pragma once

#include <algorithm>
#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit::sky {

/// Share, 0 … 1, of a disc's area on one side of a line: the side of its middle, which lies `height` radii
/// from the line; on the other side where `height` is negative. Smooth where the line leaves the disc, at −1
/// and 1.
inline double discSegment(double height) {
  const double h = std::clamp(height, -1.0, 1.0);
  return 0.5 + (h * std::sqrt(1.0 - h * h) + std::asin(h)) / kPi;
}

}  // namespace sunlit::sky
