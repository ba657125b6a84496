/// Where in a scene transport is sampled, and how surfaces find their samples.
#pragma once

#include <functional>
#include <vector>

#include "light/transport/mesh_builder.h"
#include "light/transport/probe.h"
#include "light/transport/reflectances.h"
#include "light/transport/transport_data.h"
#include "light/transport/triangle_kinds.h"

namespace sunlit::light {

/// The sample on the other side of a thin sheet.
struct OtherSide {
  std::uint32_t sample = LightMesh::kNone;
  float share = 0.0f;  ///< of its diffuse light that comes out on this side
};

struct SceneSamples {
  LightMesh mesh;
  std::vector<Receiver> receivers;            ///< of each sample, neighbours close together
  std::vector<OtherSide> other_side;          ///< of each sample
  std::vector<Paint> paints;                  ///< of the surfaces around each sample
  std::vector<float> areas_m2;                ///< of those surfaces: the third of each cell nearest to it
  std::vector<std::uint32_t> nearest_sample;  ///< the one of most weight, of each node
};

/// `progress` gets the share done, 0 … 1, about.
SceneSamples sampleScene(const BakeScene& scene, const ShiningSurfaces& shining, const RefineLimits& limits,
                         const std::function<void(double)>& progress);

}  // namespace sunlit::light
