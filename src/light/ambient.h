/// Light of the sky and of other surfaces, as one surface sends it to the eye.
#pragma once

#include "sunlit/light/illumination.h"
#include "sunlit/light/shading.h"
#include "sunlit/light/surfaces.h"

namespace sunlit::light {

/// What a mirror-like lobe looks at.
struct Mirrored {
  Eigen::Array3f sky = Eigen::Array3f::Zero();  ///< cd/m², mean over the whole lobe
  /// Share of the lobe that other surfaces hide, 0 … 1: of those above the horizon and those below.
  float hidden_above = 1.0f, hidden_below = 0.0f;
};
Mirrored mirroredBy(const MirrorView& view, const MirrorSky& sky);

/// What is known of a surface before it is lit.
struct AmbientParts {
  const AmbientReflectance& reflectance;
  const Mirrored& mirrored;     ///< where the light is baked
  const GatheredSky* gathered;  ///< null: FinalGather did not look there
};
/// Luminance, cd/m², without what sun and moon add directly.
Eigen::Array3f ambientLuminance(const Surface& surface, const Reflection& reflection,
                                const AmbientParts& parts, const Illumination& light);

}  // namespace sunlit::light
