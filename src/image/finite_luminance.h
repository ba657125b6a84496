/// Luminance that may be summed up.
#pragma once

#include <algorithm>

namespace sunlit::image {

/// NaN and what is below 0 become black, as in develop(), and infinity 1e12 cd/m².
inline float finiteLuminance(float luminance) {
  constexpr float kBrightest = 1e12F;
  return std::min(std::max(0.0F, luminance), kBrightest);
}

}  // namespace sunlit::image
