/// Where a point of one picture lies in another that was taken from elsewhere.
#pragma once

#include "sunlit/evaluate/posed_view.h"
#include "sunlit/evaluate/verify/point_maps.h"

namespace sunlit::evaluate {

/// How much the depth that a picture shows may differ from that of the place looked for, relative to the
/// latter, for both to be one. Depth between pixels of a curved or jagged surface is known to some per cent
/// only; what hides something is mostly farther off it than that.
constexpr double kSameDepth = 0.02;

/// Truth by pose and depth: the point in `map` that is seen in one view, projected into the other, whose own
/// depth there tells whether it is seen: where that is less the place is hidden, where it is more the two
/// disagree, and where it is unknown nobody knows; all of these are outside the common part. Of a plane the
/// same as homographyMaps(), but for the rounding of depth. Both views have depth; the maps share its pixels.
/// Throws std::invalid_argument for a view that requireWhole() refuses or that has no depth.
PointMaps depthMaps(const PosedView& a, const PosedView& b);

}  // namespace sunlit::evaluate
