/// Which surfaces are so smooth that rays show what they mirror.
#pragma once

#include <algorithm>

namespace sunlit::light {

/// Surfaces so smooth mirror by rays alone; towards the rougher limit the lobe of MirrorSky and of the nodes
/// takes over, evenly, so that no edge appears.
constexpr float kMirrorsByRays = 0.42f, kMirrorsByLobe = 0.48f;

/// Share of its surroundings that a surface, no thin sheet, mirrors by rays.
inline float mirroredByRays(float roughness) {
  return std::clamp((kMirrorsByLobe - roughness) / (kMirrorsByLobe - kMirrorsByRays), 0.0f, 1.0f);
}

}  // namespace sunlit::light
