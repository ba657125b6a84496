/// Unit directions in the `map` frame: ENU, x east, y north, z up (REP-103, REP-105).
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit {

/// A unit vector in `map`. A "sun direction" always points from the scene towards the sun.
class Direction {
 public:
  /// Straight up.
  Direction() = default;
  /// `vector` in `map`, of any finite length above zero; normalised here.
  explicit Direction(const Eigen::Vector3d& vector) : vector_(vector.normalized()) {}
  /// `elevation` above the horizontal plane, in [−90°, 90°].
  Direction(Azimuth azimuth, Angle elevation)
      : vector_(sin(azimuth.angle()) * cos(elevation), cos(azimuth.angle()) * cos(elevation),
                sin(elevation)) {}

  const Eigen::Vector3d& vector() const { return vector_; }
  Azimuth azimuth() const { return Azimuth(Angle::radians(std::atan2(vector_.x(), vector_.y()))); }
  /// In [−90°, 90°].
  Angle elevation() const { return Angle::radians(std::asin(std::clamp(vector_.z(), -1.0, 1.0))); }

 private:
  Eigen::Vector3d vector_ = Eigen::Vector3d::UnitZ();
};

}  // namespace sunlit
