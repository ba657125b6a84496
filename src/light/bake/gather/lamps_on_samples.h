/// Direct light of lamps on the surfaces of a scene, sample by sample: what they then pass on.
#pragma once

#include <vector>

#include "light/bake/gather/sent_light.h"
#include "light/bake/samples/scene_samples.h"
#include "light/lamps/lamp_beam.h"

namespace sunlit::light {

/// Of all of some lamps together, with their shadows.
/// Lamps that together give less than a hundredth of what all give at a triangle, or next to nothing, are
/// left out there. Parallel; the same bits for any number of threads.
StraightLight lampsOnSamples(const BakeScene& scene, const SceneSamples& samples,
                             const std::vector<LampBeam>& lamps);

}  // namespace sunlit::light
