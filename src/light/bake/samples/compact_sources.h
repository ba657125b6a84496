/// Surfaces that shine by themselves and are so small that pictures look for their light as for that of
/// lamps: their shadows would be finer than the bake's samples.
#pragma once

#include <vector>

#include "light/bake/samples/area_lights.h"
#include "light/bake/samples/transport_data.h"
#include "sunlit/light/lamps.h"

namespace sunlit::light {

/// What shines, parted: each piece is one of those `of_compact`, which give their light straight by the
/// sources `compact`, or among the `others`.
struct ShiningParts {
  std::vector<CompactSource> compact;
  std::vector<AreaLights::Piece> of_compact, others;
};

/// Of pieces that touch, and together reach no further than 1.5 m from their middle: bodies that show as
/// large as an ellipsoid within a tenth, to all sides, and are not long, such as bulbs; straight, even tubes
/// at least four times as long as they are thick; and those nearly all of whose light is that of six faces at
/// most, each flat and about as large as a rectangle of its length and width, such as panels. The most
/// powerful of them, 256 at most, but none whose light others drown `height_m` below: a hundred panels of a
/// hall, or a string of lights. The same for equal `pieces`.
ShiningParts partedBySize(const std::vector<AreaLights::Piece>& pieces, float height_m);

KeptSource kept(const CompactSource& source);
CompactSource sourceOf(const KeptSource& kept);

}  // namespace sunlit::light
