/// Bodies that shine by themselves, as what pictures can look for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "light/bake/samples/area_lights.h"
#include "sunlit/light/lamps.h"

namespace sunlit::light {

/// A source and the pieces whose light it has.
struct CompactShape {
  CompactSource source;
  float power = 0.0f;
  std::vector<std::uint32_t> pieces;  ///< empty: of the other side of the one before
  std::size_t body = 0;
};

/// Of a body that reaches at most `largest_m` from its middle: as an ellipsoid, or as a tube, or as the faces
/// that have nearly all of its light; none where it is of no such shape. `body` is numbers of `pieces`.
std::vector<CompactShape> compactShapes(const std::vector<AreaLights::Piece>& pieces,
                                        const std::vector<std::uint32_t>& body, float largest_m);

}  // namespace sunlit::light
