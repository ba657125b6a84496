/// Light of the sky and of other surfaces, as one surface sends it to the eye.
#pragma once

#include "sunlit/light/illumination.h"
#include "sunlit/light/shading.h"
#include "sunlit/light/surfaces.h"

namespace sunlit::light {

/// Luminance, cd/m², without what sun and moon add directly.
Eigen::Array3f ambientLuminance(const Surface& surface, const Reflection& reflection,
                                const Illumination& light);

}  // namespace sunlit::light
