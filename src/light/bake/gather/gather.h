/// How much of each sky patch's light arrives at the samples of a scene.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "light/bake/gather/lamp_bounces.h"
#include "light/bake/samples/scene_samples.h"
#include "light/bake/samples/transport_data.h"

namespace sunlit::light {

/// Share of the work done, 0 … 1; may come from any thread, but never from two at once.
using GatherProgress = std::function<void(double)>;

struct GatherOptions {
  int rays_per_patch = 3;
  int bounces = 3;
  ShiningLights shining;
  GatherProgress progress;
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
