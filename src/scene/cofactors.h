/// How normals go where points go by a matrix.
#pragma once

#include <Eigen/Geometry>

namespace sunlit::scene {

/// Of `linear`: what turns normals, up to their length, and to the wrong side if it mirrors. Defined for
/// flattening scales too, which have no inverse.
inline Eigen::Matrix3d cofactors(const Eigen::Matrix3d& linear) {
  Eigen::Matrix3d matrix;
  matrix << linear.col(1).cross(linear.col(2)), linear.col(2).cross(linear.col(0)),
      linear.col(0).cross(linear.col(1));
  return matrix;
}

}  // namespace sunlit::scene
