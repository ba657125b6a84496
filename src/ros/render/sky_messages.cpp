#include "ros/render/sky_messages.h"

#include <Eigen/Geometry>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "sunlit/ros/frame_names.h"

namespace sunlit::ros_interface {

namespace {

void requireMapFrame(const std_msgs::Header& header) {
  if (header.frame_id != kMapFrame)
    throw std::invalid_argument("frame_id is \"" + header.frame_id + "\", but must be \"" + kMapFrame + '"');
}

void requireWithin(const char* field, double value, double low, double high) {
  if (value >= low && value <= high) return;  // false for NaN too
  std::ostringstream text;
  text << field << " is " << value << ", but must be " << low << " to " << high;
  throw std::invalid_argument(text.str());
}

void requireUnitLength(const char* field, double length) {
  if (std::abs(length - 1.0) < 1e-3) return;
  std::ostringstream text;
  text << field << " is of length " << length << ", but must be of length 1";
  throw std::invalid_argument(text.str());
}

Direction directionOf(const geometry_msgs::Vector3& message) {
  const Eigen::Vector3d vector(message.x, message.y, message.z);
  requireUnitLength("direction", vector.norm());
  return Direction(vector);
}

Direction geometricOf(const Direction& apparent, double elevation_geometric) {
  requireWithin("elevation_geometric", elevation_geometric, -0.5 * kPi, 0.5 * kPi);
  return Direction(apparent.azimuth(), Angle::radians(elevation_geometric));
}

}  // namespace

// The ranges are those of sky/atmosphere.h and sky/night.h.

sky::SunInSky fromMessage(const SunPosition& message) {
  requireMapFrame(message.header);
  requireWithin("distance_au", message.distance_au, 0.97, 1.03);
  const Direction apparent = directionOf(message.direction);
  return {apparent, message.distance_au, geometricOf(apparent, message.elevation_geometric)};
}

sky::MoonInSky fromMessage(const MoonPosition& message) {
  requireMapFrame(message.header);
  requireWithin("distance", message.distance, 3.4e8, 4.2e8);
  requireWithin("phase_angle", message.phase_angle, 0.0, kPi);
  sky::MoonInSky moon;
  moon.apparent = directionOf(message.direction);
  moon.geometric = geometricOf(moon.apparent, message.elevation_geometric);
  moon.distance_m = message.distance;
  moon.phase_angle = Angle::radians(message.phase_angle);
  return moon;
}

Eigen::Matrix3d fromMessage(const geometry_msgs::QuaternionStamped& message) {
  requireMapFrame(message.header);
  const geometry_msgs::Quaternion& q = message.quaternion;
  const Eigen::Quaterniond rotation(q.w, q.x, q.y, q.z);
  requireUnitLength("quaternion", rotation.norm());
  return rotation.normalized().toRotationMatrix();
}

}  // namespace sunlit::ros_interface
