/// Rays that carry equal parts of a lamp's power.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sunlit/scene/scene.h"

namespace sunlit::light {

struct PowerRays {
  std::vector<Eigen::Vector3f> directions;  ///< unit, z along the lamp's axis; fill its cone by its falloff
  std::vector<std::uint32_t> groups;        ///< of neighbours: one a ray
  float each_sr;                            ///< of the lamp's full intensity, that one of them stands for
};

/// A function of the lamp's cone alone, so that its rays turn with it. Some groups may have no ray.
PowerRays powerRays(const scene::Lamp& lamp, std::size_t count, std::size_t groups);

}  // namespace sunlit::light
