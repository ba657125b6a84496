/// Turns from one vector to another.
#pragma once

#include <Eigen/Geometry>

namespace sunlit {

/// The least turn that brings the direction of `from` to that of `to`, both finite and longer than zero; of
/// opposite ones about any axis at right angles. As Eigen has it, compiled once: that takes seconds.
Eigen::Quaterniond turnBetween(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

}  // namespace sunlit
