/// What shines on a camera, and is not in its picture.
#pragma once

#include <vector>

#include "sunlit/image/veiling_glare.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {

/// As PreparedPicture::lightsOutside(). `visibility` is of what stands in the picture of `surfaces`.
std::vector<image::LightOutside> lightsOutside(const Surfaces& surfaces, const Visibility& visibility,
                                               const Illumination& light, float nearest_m);

}  // namespace sunlit::light
