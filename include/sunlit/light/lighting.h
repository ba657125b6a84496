/// Lights what a camera sees.
#pragma once

#include "sunlit/image/images.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {

/// Computes what illuminate() needs of `surfaces` for any light, which saves each condition that work. To be
/// called once all else of them is set, and again when anything of them has changed. Parallel.
void prepare(const scene::Scene& scene, Surfaces* surfaces);

/// Luminance of each pixel, cd/m²: the sun's disc where rays reach it, light of the open sky by surface
/// direction, emission, and the sky and sun themselves where no surface is seen. Parallel; the same bits for
/// any thread count.
image::LinearImage illuminate(const Surfaces& surfaces, const scene::Scene& scene,
                              const Visibility& visibility, const Illumination& light);

}  // namespace sunlit::light
