/// Where the camera of a view from straight above stands.
#pragma once

#include <Eigen/Geometry>

#include "sunlit/light/world.h"
#include "sunlit/quantity/range.h"
#include "sunlit/render/renderer.h"
#include "sunlit/studio/studio.h"

namespace sunlit::studio {

/// Between what a world lies, m in `map`.
struct Heights {
  double bottom = 0.0, top = 0.0;
};
Heights heightsOf(const light::World& world);

/// Where a camera stands that looks straight down on ground, and from what depth to what it sees, m.
struct Perch {
  double height_m = 0.0;  ///< above that ground, at which a map has its scale
  double near_m = 0.0, far_m = 0.0;
};
/// `height_m.low` above the world's top, but no higher than `height_m.high` above the ground: what reaches up
/// there is not seen. Sees down to the world's bottom, wherever that is.
Perch perchOver(double ground_m, const Heights& heights, const Range& height_m);

struct Overlook {
  render::RenderOptions render;
  Eigen::Isometry3d map_from_camera;  ///< x forward, z up
};

/// Above the world's top, but no more than 100 extents above the ground under the middle, and 10 at least:
/// rays are within 3° of parallel. `render` but for its lens, near and far.
Overlook overlooking(const light::World& world, const TopDown& ground, const render::RenderOptions& render);

}  // namespace sunlit::studio
