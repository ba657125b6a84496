/// What rays of neighbouring pixels met, put together.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "light/picture/mirror/reflections.h"
#include "sunlit/light/surfaces.h"

namespace sunlit::light {

/// What each of TileReflections::surfaces shows, cd/m², in the order of Surfaces::tiles.
using MirroredLuminances = std::vector<std::vector<Eigen::Array3f>>;

/// `luminances` are what each surface's own rays show. Those of rough ones become means over like ones in
/// pixels about, whose rays together fill a lobe. Parallel.
void shareLobes(const Surfaces& surfaces, const Reflections& reflections, MirroredLuminances* luminances);

}  // namespace sunlit::light
