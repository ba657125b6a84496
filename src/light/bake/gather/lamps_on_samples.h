/// Direct light of lamps on the surfaces of a scene, sample by sample: what they then pass on.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "light/bake/samples/scene_samples.h"
#include "light/lamps/lamp_beam.h"

namespace sunlit::light {

/// Mean illuminance, lx, of the surfaces around each sample by all of `lamps` together, with their shadows.
/// Lamps that together give less than a hundredth of what all give at a triangle, or next to nothing, are
/// left out there. Parallel; the same bits for any number of threads.
std::vector<Eigen::Array3f> lampsOnSamples(const BakeScene& scene, const SceneSamples& samples,
                                           const std::vector<LampBeam>& lamps);

}  // namespace sunlit::light
