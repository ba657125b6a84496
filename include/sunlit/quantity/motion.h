/// How a thing moves while it is looked at.
#pragma once

#include <Eigen/Geometry>

namespace sunlit {

/// Constant over the moment that it is used for: a few hundredths of a second. What it does is compiled once:
/// in a header it took a second of each file.
struct Motion {
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();   ///< in `map`
  Eigen::Vector3d turning_rad_s = Eigen::Vector3d::Zero();  ///< about axes of `map` through the thing itself

  bool none() const;

  /// What takes points of a thing at `place` to where they are `seconds` later: times map_from_thing, its
  /// pose then.
  Eigen::Isometry3d after(double seconds, const Eigen::Vector3d& place) const;

  /// By which `map_from_first` becomes `map_from_second` in `seconds`, ≠ 0, straight and by the shortest
  /// turn.
  static Motion between(const Eigen::Isometry3d& map_from_first, const Eigen::Isometry3d& map_from_second,
                        double seconds);
};

}  // namespace sunlit
