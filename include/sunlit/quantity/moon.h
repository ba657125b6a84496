/// What both the moon's place and its light need to know of it.
#pragma once

namespace sunlit {

/// Mean radius of the moon (IAU, Archinal et al. 2018).
constexpr double kMoonRadius_m = 1737.4e3;

/// Mean distance between the centres of Earth and moon.
constexpr double kMeanMoonDistance_m = 384400e3;

}  // namespace sunlit
