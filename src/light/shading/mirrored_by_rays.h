/// Which surfaces are so smooth that rays show what they mirror.
#pragma once

#include <algorithm>

namespace sunlit::light {

struct MirrorsByRays {
  /// Surfaces at most so rough mirror by rays alone; from `none` on the lobe of MirrorSky and of the nodes
  /// does, and takes over evenly in between, so that no edge appears.
  float all, none;

  /// Share of its surroundings that a surface, no thin sheet, mirrors by rays.
  float share(float roughness) const { return std::clamp((none - roughness) / (none - all), 0.0f, 1.0f); }
};

constexpr MirrorsByRays kSmoothOnes{0.42f, 0.48f};
/// Of those that a camera sees where something shines by itself: lobes know the mean of all surfaces above
/// and of all below, and a panel is hundreds of times as bright as that.
constexpr MirrorsByRays kBeforePanels{0.75f, 0.85f};

}  // namespace sunlit::light
