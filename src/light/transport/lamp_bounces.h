/// Bakes what standing lamps give by way of surfaces.
#pragma once

#include "light/transport/exchange.h"
#include "light/transport/scene_samples.h"
#include "light/transport/transport_data.h"

namespace sunlit::light {

/// Of each of the scene's lampSets(), by at most `bounces` from surface to surface. Parallel; the same bits
/// for any number of threads.
BakedLamps bakeLamps(const BakeScene& scene, const SceneSamples& samples, const Exchange& exchange,
                     int bounces);

/// Adds `share` of the light of a set to what samples have: of BakedLamps::Light in lx, one a sample.
void addLamps(const BakedLamps& lamps, std::size_t set, float share, std::vector<BakedLamps::Light>* light);

}  // namespace sunlit::light
