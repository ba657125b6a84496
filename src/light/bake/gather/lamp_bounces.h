/// Bakes what standing lamps give by way of surfaces.
#pragma once

#include "light/bake/gather/exchange.h"
#include "light/bake/samples/scene_samples.h"
#include "light/bake/samples/transport_data.h"

namespace sunlit::light {

/// Of each of the scene's lampSets(), by at most `bounces` from surface to surface. Parallel; the same bits
/// for any number of threads.
BakedLamps bakeLamps(const BakeScene& scene, const SceneSamples& samples, const Exchange& exchange,
                     int bounces);

/// Adds `share` of the light of a set to what samples have: of BakedLamps::Light in lx, one a sample.
void addLamps(const BakedLamps& lamps, std::size_t set, float share, std::vector<BakedLamps::Light>* light);

}  // namespace sunlit::light
