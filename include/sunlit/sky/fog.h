/// Droplets in the air near the ground.
#pragma once

namespace sunlit::sky {

/// An even layer of fog, haze or falling rain; the default is none.
struct Fog {
  float per_m = 0.0F;  ///< extinction: all of it is scattered, none absorbed
  float top_m = 0.0F;  ///< above the observer
};

/// Of what droplets scatter, the part that goes into 1 sr at an angle of that cosine from its old way: Henyey
/// and Greenstein 1941.
float dropletPhase(float cos_angle);
/// Its mean cosine (of cloud in visible light: Slingo 1989). Real droplets have a narrower peak and bows
/// besides.
constexpr double kDropletAsymmetry = 0.86;

}  // namespace sunlit::sky
