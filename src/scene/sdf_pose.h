/// Poses and vectors of SDF as Eigen's.
#pragma once

#include <Eigen/Geometry>
#include <ignition/math/Pose3.hh>
#include <ignition/math/Vector3.hh>
#include <sdf/sdf.hh>
#include <stdexcept>
#include <string>

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

/// The pose of a model, link or visual in the frame that SDF means by default: its parent's. Throws
/// std::runtime_error with `name` where it cannot be resolved.
template <typename Element>
Eigen::Isometry3d parentFrom(const Element& element, const std::string& name) {
  ignition::math::Pose3d pose;
  sdf::Errors errors = element.SemanticPose().Resolve(pose);
#if SDF_MAJOR_VERSION < 12
  // A model that is in no world stands in no tree of poses there.
  if (!errors.empty() && element.PoseRelativeTo().empty()) {
    pose = element.RawPose();
    errors.clear();
  }
#endif
  if (!errors.empty())
    throw std::runtime_error(name + ": its pose cannot be resolved: " + errors[0].Message());
  return toEigen(pose);
}

}  // namespace sunlit::scene
