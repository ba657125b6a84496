/// How much of each sky patch's light arrives at the samples of a scene.
#pragma once

#include <cstdint>
#include <vector>

#include "light/bake/gather/lamp_bounces.h"
#include "light/bake/samples/scene_samples.h"
#include "light/bake/samples/transport_data.h"
#include "light/bake/samples/work_done.h"

namespace sunlit::light {

struct GatherOptions {
  int rays_per_patch = 3;
  int bounces = 3;
  ShiningLights shining;
  Progress progress = nullptr;
};

/// Samples inside bodies, whose light is of no use.
struct UselessSamples {
  std::vector<bool> are;                ///< of each sample
  std::vector<std::uint32_t> in_place;  ///< of each node, LightMesh::usefulSamples()
};

/// Fills `data` but for its mesh. Parallel; the same bits for any number of threads. Throws
/// std::runtime_error for more than 2^24 samples.
UselessSamples gatherLight(const BakeScene& scene, const SceneSamples& samples, const GatherOptions& options,
                           TransportData* data);

}  // namespace sunlit::light
