/// What of the sky rough surfaces mirror.
#pragma once

#include "light/picture/mirror/open_patches.h"
#include "sunlit/scene/scene.h"

namespace sunlit::light {

/// Of a surface of `material` that has `open` before it: directReflectance() of its mirror-like part, summed
/// over each patch. Where a lobe is narrower than patches, as where the roughness is below 0.4, the
/// few directions looked at in each tell too little. Among leaves, each of which mirrors something else than
/// its neighbour, less will do.
RoughMirror roughMirror(const Surface& surface, const scene::Material& material, const OpenPatches& open,
                        bool leaf);

}  // namespace sunlit::light
