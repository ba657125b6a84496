/// Lights what a camera sees.
#pragma once

#include "light/picture/ready_picture.h"
#include "sunlit/image/images.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/visibility.h"
#include "sunlit/scene/scene.h"

namespace sunlit::light {

/// Luminance of each pixel, cd/m²: see PreparedPicture::illuminate(). `visibility` is of `scene`, with the
/// bodies that stand in the picture.
image::LinearImage illuminate(const ReadyPicture& picture, const scene::Scene& scene,
                              const Visibility& visibility, const Illumination& light);

}  // namespace sunlit::light
