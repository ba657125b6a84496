/// Light of the sky and of other surfaces, as one surface sends it to the eye.
#pragma once

#include "sunlit/light/illumination.h"
#include "sunlit/light/shading.h"
#include "sunlit/light/surfaces.h"

namespace sunlit::light {

/// The part of the sky that a mirror-like lobe looks at, cd/m², mean over the whole lobe; fourth: how much of
/// the lobe other surfaces leave free, 0 … 1.
Eigen::Array4f mirroredSky(const MirrorView& view, const MirrorSky& sky);

/// What is known of a surface before it is lit.
struct AmbientParts {
  const AmbientReflectance& reflectance;
  const Eigen::Array4f& mirrored_sky;  ///< where the light is baked
};
/// Luminance, cd/m², without what sun and moon add directly.
Eigen::Array3f ambientLuminance(const Surface& surface, const Reflection& reflection,
                                const AmbientParts& parts, const Illumination& light);

}  // namespace sunlit::light
