#include "sunlit/quantity/motion.h"

namespace sunlit {

bool Motion::none() const {
  return velocity_m_s.isZero(0.0) && turning_rad_s.isZero(0.0);
}

Eigen::Isometry3d Motion::after(double seconds, const Eigen::Vector3d& place) const {
  Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
  const double turned_rad = seconds * turning_rad_s.norm();
  if (turned_rad != 0.0)
    moved.linear() = Eigen::AngleAxisd(turned_rad, turning_rad_s.normalized()).toRotationMatrix();
  moved.translation() = place + seconds * velocity_m_s - moved.linear() * place;
  return moved;
}

Motion Motion::between(const Eigen::Isometry3d& map_from_first, const Eigen::Isometry3d& map_from_second,
                       double seconds) {
  Motion motion;
  motion.velocity_m_s = (map_from_second.translation() - map_from_first.translation()) / seconds;
  if (map_from_first.linear() == map_from_second.linear()) return motion;  // which rounding would turn
  const Eigen::AngleAxisd turn(
      Eigen::Matrix3d(map_from_second.linear() * map_from_first.linear().transpose()));
  motion.turning_rad_s = turn.angle() / seconds * turn.axis();
  return motion;
}

}  // namespace sunlit
