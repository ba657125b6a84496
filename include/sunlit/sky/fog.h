/// Droplets in the air near the ground.
#pragma once

#include <algorithm>
#include <limits>

namespace sunlit::sky {

/// An even layer of fog, haze or falling rain; the default is none.
struct Fog {
  float per_m = 0.0F;  ///< extinction: all of it is scattered, none absorbed
  float top_m = 0.0F;  ///< above the observer; below 0 where that one stands above it

  /// Where the way of an eye that looks at an elevation of sine `z` enters the layer and leaves it, m from
  /// the eye: 0 within it. Infinite where it never does.
  float begins(float z) const {
    if (top_m >= 0.0F) return 0.0F;
    return z < 0.0F ? top_m / z : std::numeric_limits<float>::infinity();
  }
  float ends(float z) const {
    return top_m >= 0.0F && z > 0.0F ? top_m / z : std::numeric_limits<float>::infinity();
  }
  /// How much of the first `distance_m` of that way lies in it.
  float within(float z, float distance_m) const {
    const float begin_m = begins(z), end_m = std::min(distance_m, ends(z));
    return begin_m < end_m ? end_m - begin_m : 0.0F;
  }
};

/// Of what droplets scatter, the part that goes into 1 sr at an angle of that cosine from its old way: Henyey
/// and Greenstein 1941.
float dropletPhase(float cos_angle);
/// Its mean cosine (of cloud in visible light: Slingo 1989). Real droplets have a narrower peak and bows
/// besides.
constexpr double kDropletAsymmetry = 0.86;

}  // namespace sunlit::sky
