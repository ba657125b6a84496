/// A disc that a line cuts, as the horizon cuts sun and moon.
#pragma once

#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit::sky {

/// Share, 0 … 1, of a disc's area on one side of a line: the side of its middle, which lies `height` radii
/// from the line; on the other side where `height` is negative. Smooth where the line leaves the disc, at −1
/// and 1.
inline double discSegment(double height) {
  if (height >= 1.0) return 1.0;
  if (height <= -1.0) return 0.0;
  return 0.5 + (height * std::sqrt(1.0 - height * height) + std::asin(height)) / kPi;
}

}  // namespace sunlit::sky
