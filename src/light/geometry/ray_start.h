/// Where rays leave the surfaces of a picture.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "sunlit/light/surfaces.h"

namespace sunlit::light {

/// Of sample number `at` of Tile::origin_x …, on the side that is seen, m in `map`.
inline Eigen::Vector3f rayStart(const Tile& tile, std::size_t at) {
  return {tile.origin_x[at], tile.origin_y[at], tile.origin_z[at]};
}
/// The same on the side of `surface` that a ray along `way` goes to.
inline Eigen::Vector3f rayStart(const Tile& tile, std::size_t at, const Surface& surface,
                                const Eigen::Vector3f& way) {
  const Eigen::Vector3f front = rayStart(tile, at);
  if (surface.geometric_normal.dot(way) > 0.0f) return front;
  return front - 2.0f * surface.clearance_m * surface.geometric_normal;
}

}  // namespace sunlit::light
