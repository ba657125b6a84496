/// How much of the sky a surface has before it, patch by patch.
#pragma once

#include "light/bake/samples/transport_data.h"
#include "light/patches/mirror_places.h"
#include "light/picture/outlook/outlook.h"
#include "sunlit/light/surfaces.h"

namespace sunlit::light {

struct OpenPatches {
  PatchValues share;  ///< 0 … 1
  PatchValues known;  ///< 1, or 0 where the surface's samples don't tell, and `share` is 0
  PackedTint tint;    ///< of what is open, by glass before it, in the mean
};

/// By what was gathered there, if anything; else by the surface's view of the sky as a leaf, or by the
/// samples of `data` around it. `outlook` and `material` are its own; thin sheets see the sky on both sides,
/// but by samples.
OpenPatches openPatches(const TransportData& data, const Surface& surface, const WholeOutlook& outlook,
                        const scene::Material& material);

}  // namespace sunlit::light
