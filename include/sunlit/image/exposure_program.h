/// Aperture and time of one camera in all light, at ISO 100: in ever less light it exposes longer, then its
/// lens opens, and then the gain rises.
#pragma once

#include <cmath>

namespace sunlit::image {

constexpr double kUsualStop = 2.8;         ///< f-number while that is enough
constexpr double kWidestStop = 1.4;        ///< that the lens opens to
constexpr double kLongest_s = 1.0 / 30.0;  ///< no picture is exposed for longer

/// EV100 of the least light that fills the sensor, to a tenth, as people type it.
inline double leastFullEv100() {
  return std::round(10.0 * std::log2(kWidestStop * kWidestStop / kLongest_s)) / 10.0;
}

}  // namespace sunlit::image
