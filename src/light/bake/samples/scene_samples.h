/// Where in a scene transport is sampled, and how surfaces find their samples.
#pragma once

#include <vector>

#include "light/bake/samples/mesh_builder.h"
#include "light/bake/samples/probe.h"
#include "light/bake/samples/transport_data.h"
#include "light/bake/samples/triangle_kinds.h"
#include "light/bake/samples/work_done.h"
#include "light/shading/reflectances.h"

namespace sunlit::light {

/// The sample on the other side of a thin sheet.
struct OtherSide {
  std::uint32_t sample = LightMesh::kNone;
  float share = 0.0f;        ///< of its diffuse light that comes out on this side
  bool shares_rays = false;  ///< both look from the same places, so that rays of one serve the other, too
};

struct SceneSamples {
  LightMesh mesh;
  std::vector<Receiver> receivers;            ///< of each sample, neighbours close together
  std::vector<OtherSide> other_side;          ///< of each sample
  std::vector<Paint> paints;                  ///< of the surfaces around each sample
  std::vector<float> areas_m2;                ///< of those surfaces: the third of each cell nearest to it
  std::vector<std::uint32_t> nearest_sample;  ///< the one of most weight, of each node
};

SceneSamples sampleScene(const BakeScene& scene, const AreaLights& bright, const RefineLimits& limits,
                         const Progress& progress);

}  // namespace sunlit::light
