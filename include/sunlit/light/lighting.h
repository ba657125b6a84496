/// Lights what a camera sees.
#pragma once

#include "sunlit/image/images.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"
#include "sunlit/light/world.h"

namespace sunlit::light {

class BodyLight;

/// Sets Surfaces::reflections: what smooth surfaces mirror, by a ray from each of their samples, ready to be
/// lit. To be called once the places of `surfaces` are known, see Transport::locate(). `visibility` may know
/// bodies, which `bodies` then is of; else null. Parallel; next to nothing where nothing is smooth.
void reflect(const World& world, const Visibility& visibility, const BodyLight* bodies, Surfaces* surfaces);

/// Computes what illuminate() needs of `surfaces` for any light, which saves each condition that work. To be
/// called once all else of them is set, and again when anything of them has changed. Parallel.
void prepare(const scene::Scene& scene, Surfaces* surfaces);

/// Luminance of each pixel, cd/m²: the discs of sun and moon where rays reach them, light of the sky and of
/// other surfaces as far as `light` and `surfaces` know it (else of the open sky by surface direction),
/// emission, the air before all that, dark where no sky is open to it, and the sky with sun, moon and stars
/// where no surface is seen. Parallel; the same bits for any thread count.
image::LinearImage illuminate(const Surfaces& surfaces, const scene::Scene& scene,
                              const Visibility& visibility, const Illumination& light);

}  // namespace sunlit::light
