/// Rigid transforms between named frames. A transform is called destination_from_source.
#pragma once

#include <Eigen/Geometry>

#include "sunlit/quantity/range.h"

namespace sunlit {

/// Coordinates of `map` beyond this, m, are a mistake of units or of frame; a float, as rendering uses,
/// resolves 0.5 m there. Also keeps lengths, counts and rays far from overflow.
constexpr double kFarthestPose_m = 1e7;
/// Those that are none, along each axis.
constexpr Range kPoseRange_m{-kFarthestPose_m, kFarthestPose_m};

/// `camera_link` (x forward, y left, z up; REP-103) from `camera_optical_frame` (z forward, x right, y down).
inline Eigen::Isometry3d linkFromOptical() {
  Eigen::Isometry3d link_from_optical = Eigen::Isometry3d::Identity();
  link_from_optical.linear() << 0, 0, 1,  //
      -1, 0, 0,                           //
      0, -1, 0;
  return link_from_optical;
}

}  // namespace sunlit
