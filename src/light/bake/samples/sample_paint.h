/// What the surfaces around each sample send back.
#pragma once

#include "light/bake/samples/scene_samples.h"

namespace sunlit::light {

/// Fills the parts of `samples` that follow from its mesh.
void paintSamples(const Geometry& geometry, SceneSamples* samples);

}  // namespace sunlit::light
