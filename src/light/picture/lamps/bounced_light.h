/// What surfaces pass on of the light of lamps that move.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "sunlit/light/lamps.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {

/// One bounce of the light of `lamps`, which burn, none of them relative: some tens of places where their
/// rays end. Rays stand still in each lamp's own frame, and each finds its place by itself, so that little
/// changes while the body moves a little. Surfaces pass on evenly what they do not mirror by rays.
/// `map_from_body`: of all bodies; `visibility` knows them where they stand.
std::vector<BouncedLight> bouncedLight(const std::vector<BodyLamp>& lamps,
                                       const std::vector<Eigen::Isometry3d>& map_from_body,
                                       const Visibility& visibility);

}  // namespace sunlit::light
