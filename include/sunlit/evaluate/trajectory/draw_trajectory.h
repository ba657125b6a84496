/// A picture of an estimated trajectory and its errors, to look at.
#pragma once

#include "sunlit/evaluate/trajectory/trajectory_evaluation.h"
#include "sunlit/image/images.h"

namespace sunlit::evaluate {

/// 1200 × 1000 px: above, seen from above, x to the right and y up, all of `truth` in grey and the matched
/// poses of the aligned estimate by the colour of their absolute error, each joined to its true place; below,
/// that error along the matched poses of the truth.
image::Rgb8Image drawTrajectory(const Trajectory& truth, const TrajectoryEvaluation& evaluation);

}  // namespace sunlit::evaluate
