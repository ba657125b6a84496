/// Neighbours close together in memory.
#pragma once

#include "light/bake/samples/scene_samples.h"

namespace sunlit::light {

/// Sorts the samples by block of the scene, then by facing, then by place: rays of neighbours then travel
/// together, and gathering finds what it reads in the cache. Nodes follow the samples that have most weight
/// in them: those that a picture shows find their light in rows side by side.
void orderSamples(SceneSamples* samples);

}  // namespace sunlit::light
