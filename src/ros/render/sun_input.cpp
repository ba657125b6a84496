#include "ros/render/sun_input.h"

#include <cmath>

#include "ros/render/messages.h"

namespace sunlit::ros_interface {

SunInput::SunInput(ros::NodeHandle node, const std::string& topic, const sky::Atmosphere& atmosphere)
    : atmosphere_(atmosphere), subscriber_(node.subscribe(topic, 1, &SunInput::onSun, this)) {}

void SunInput::onSun(const SunPosition& message) {
  const Eigen::Vector3d towards(message.direction.x, message.direction.y, message.direction.z);
  // Written so that NaN is refused too. 0.97 … 1.03 AU is what the sky takes; Earth stays well inside.
  const bool good = std::abs(towards.norm() - 1.0) < 1e-3 && message.distance_au >= 0.97 &&
                    message.distance_au <= 1.03 && std::abs(message.elevation_geometric) <= 0.5 * kPi &&
                    message.header.frame_id == kMapFrame;
  if (!good) {
    ROS_ERROR_THROTTLE(5.0,
                       "Refused a sun on %s: direction of length %g, distance_au %g, elevation_geometric %g, "
                       "frame_id \"%s\"; "
                       "wanted are a unit vector, 0.97 to 1.03, at most a quarter turn and \"%s\"",
                       topic().c_str(), towards.norm(), message.distance_au, message.elevation_geometric,
                       message.header.frame_id.c_str(), kMapFrame);
    return;
  }
  const Direction apparent(towards);
  const Direction geometric(apparent.azimuth(), Angle::radians(message.elevation_geometric));
  const bool moved = !latest_ || latest_->apparent.vector() != apparent.vector() ||
                     latest_->geometric->vector() != geometric.vector() ||
                     latest_->distance_au != message.distance_au;
  if (!moved) return;
  latest_ = sky::SunInSky{apparent, message.distance_au, geometric};
  daylight_.reset();
}

const sky::Daylight& SunInput::daylight() {
  if (!daylight_) daylight_ = atmosphere_.daylight(*latest_);
  return *daylight_;
}

}  // namespace sunlit::ros_interface
