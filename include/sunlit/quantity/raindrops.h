/// How many drops of which size rain has: Marshall & Palmer 1948, N(D) = N₀ e^(−Λ D).
#pragma once

#include <cmath>

namespace sunlit {

/// N₀, per m³ and mm of diameter.
constexpr double kRaindropsAtZero = 8000.0;

/// Λ, 1/mm, of rain of `mm_per_h` > 0; without rain infinite, and there are no drops.
inline double raindropSlope(double mm_per_h) {
  return 4.1 * std::pow(mm_per_h, -0.21);
}

}  // namespace sunlit
