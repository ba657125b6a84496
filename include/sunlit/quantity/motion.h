/// How a thing moves while it is looked at.
#pragma once

#include <Eigen/Geometry>

namespace sunlit {

/// Constant over the moment that it is used for: a few hundredths of a second.
struct Motion {
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();   ///< in `map`
  Eigen::Vector3d turning_rad_s = Eigen::Vector3d::Zero();  ///< about axes of `map` through the thing itself

  bool none() const { return velocity_m_s.isZero(0.0) && turning_rad_s.isZero(0.0); }

  /// What takes points of a thing at `place` to where they are `seconds` later: times map_from_thing, its
  /// pose then.
  Eigen::Isometry3d after(double seconds, const Eigen::Vector3d& place) const {
    Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
    const double turned_rad = seconds * turning_rad_s.norm();
    if (turned_rad != 0.0)
      moved.linear() = Eigen::AngleAxisd(turned_rad, turning_rad_s.normalized()).toRotationMatrix();
    moved.translation() = place + seconds * velocity_m_s - moved.linear() * place;
    return moved;
  }

  /// By which `map_from_first` becomes `map_from_second` in `seconds`, ≠ 0, straight and by the shortest
  /// turn.
  static Motion between(const Eigen::Isometry3d& map_from_first, const Eigen::Isometry3d& map_from_second,
                        double seconds) {
    Motion motion;
    motion.velocity_m_s = (map_from_second.translation() - map_from_first.translation()) / seconds;
    if (map_from_first.linear() == map_from_second.linear()) return motion;  // which rounding would turn
    const Eigen::AngleAxisd turn(
        Eigen::Matrix3d(map_from_second.linear() * map_from_first.linear().transpose()));
    motion.turning_rad_s = turn.angle() / seconds * turn.axis();
    return motion;
  }
};

}  // namespace sunlit
