/// Poses and vectors of SDF as Eigen's.
#pragma once

#include <Eigen/Geometry>
#include <ignition/math/Pose3.hh>
#include <ignition/math/Vector3.hh>

namespace sunlit::scene {

inline Eigen::Vector3d toEigen(const ignition::math::Vector3d& vector) {
  return {vector.X(), vector.Y(), vector.Z()};
}

inline Eigen::Isometry3d toEigen(const ignition::math::Pose3d& pose) {
  const ignition::math::Quaterniond& q = pose.Rot();
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.translate(toEigen(pose.Pos()));
  transform.rotate(Eigen::Quaterniond(q.W(), q.X(), q.Y(), q.Z()));
  return transform;
}

}  // namespace sunlit::scene
