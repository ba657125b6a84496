/// Cloth, paper and leaves that are no cards: what light passes through them.
#pragma once

#include "light/bake/samples/scene_samples.h"

namespace sunlit::light {

/// Sets `other_side` of samples on sheets that transmit light and are no cards: the sample behind them. Needs
/// `nearest_sample`.
void coupleSheets(const BakeScene& scene, SceneSamples* samples);

}  // namespace sunlit::light
