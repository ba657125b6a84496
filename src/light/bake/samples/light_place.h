/// Where surfaces find their light among what a bake keeps.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "light/bake/samples/node_lights.h"
#include "light/geometry/triangle_side.h"

namespace sunlit::light {

struct LightMesh;

/// Where a surface finds its sky light and bounced light: the weighted mean of three nodes of the Transport.
struct LightPlace {
  static constexpr std::uint32_t kNowhere = 0xffffffffu;
  std::array<std::uint32_t, 3> node = {kNowhere, kNowhere, kNowhere};  ///< all or none kNowhere
  std::array<float, 3> weight = {1.0f, 0.0f, 0.0f};                    ///< sum 1; 0 in a closed body

  bool known() const { return node[0] != kNowhere; }
};

/// Of a point of a side, given by its barycentric coordinates. A side that cannot be seen, but is met by
/// light or in a mirror, has the light of the other.
LightPlace lightPlace(const LightMesh& mesh, const TriangleSide& side, const std::array<float, 3>& within);

/// Illuminance at a place between `nodes`, lx.
inline Eigen::Array3f irradianceAt(const LightPlace& place, const NodeLights& nodes) {
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  for (std::size_t k = 0; k < 3; ++k) sum += place.weight[k] * nodes.irradiance(place.node[k]);
  return sum.head<3>();
}

}  // namespace sunlit::light
