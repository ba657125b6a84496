/// A picture of an estimated trajectory and its errors, to look at.
#pragma once

#include <string>

#include "sunlit/evaluate/trajectory/trajectory_evaluation.h"
#include "sunlit/image/images.h"

namespace sunlit::evaluate {

/// Ground seen from above, x to the right and y up.
struct MapPicture {
  image::Rgb8Image picture;
  double x_min = 0.0, x_max = 0.0, y_min = 0.0, y_max = 0.0;  ///< of its edges, m
};

/// map.png and map.yaml of an experiment's output folder. Throws std::runtime_error naming file, key and what
/// is expected.
MapPicture readMapPicture(const std::string& folder);

/// 1200 × 1000 px: above, seen from above, x to the right and y up, all of `truth` in grey and the matched
/// poses of the aligned estimate by the colour of their absolute error, each joined to its true place; below,
/// that error along the matched poses of the truth. Under the former, pale, `map` as far as it reaches; null
/// for none.
image::Rgb8Image drawTrajectory(const Trajectory& truth, const TrajectoryEvaluation& evaluation,
                                const MapPicture* map = nullptr);

}  // namespace sunlit::evaluate
