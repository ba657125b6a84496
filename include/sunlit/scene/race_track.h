/// The built-in world: a closed race track and its surroundings, our standard environment for tests of vision
/// under changing light. Made in code, the same bits at every call.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sunlit/scene/scene.h"

namespace sunlit::scene {

Scene raceTrack();

/// The built-in path around it: points on the road surface in `map`, m, in driving order. Sampled every 1 m
/// by the paper's rule it gives exactly 991 poses.
std::vector<Eigen::Vector3d> raceTrackWaypoints();

}  // namespace sunlit::scene
