/// Two cameras side by side, as their calibration files tell of them.
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "sunlit/image/calibration.h"

namespace sunlit::image {

/// The right one of a pair.
struct RightCamera {
  Calibration calibration;
  /// Of the optical frames of the cameras themselves, m: z forward, x right, y down.
  Eigen::Isometry3d left_from_right = Eigen::Isometry3d::Identity();
};

/// As sensor_msgs/CameraInfo has a pair: R turns each camera's frame into one that both share, but that the
/// right one stands B = -P[3] / P[0] farther along x (m, where the calibration board was told of in m).
/// Throws std::invalid_argument naming key, value and what is allowed where R is no rotation, where size or P
/// are not those of the left one (but for P[2], as some pairs look at different places), where P[3] of the
/// left one is not 0 and where B is not in the range of baselineRow(); before each key stands `called`.
RightCamera calibratedRight(const Calibration& left, const Calibration& right, const std::string& called);

/// A camera like the left one, `baseline_m` (above 0) to the right of it: along the x of its rectified
/// pictures. Throws as calibratedRight().
RightCamera idealRight(const Calibration& left, double baseline_m, const std::string& called);

/// What idealRight() is told, kept at `place`; 0 for no such camera.
inline Field baselineRow(double* place) {
  return {"baseline", place, "m", {0, 100}, "to an ideal right camera, like this one; 0: there is none"};
}

}  // namespace sunlit::image
