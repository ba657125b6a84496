/// What is sent of sun, moon and stars; the requests are in messages.cpp.
#include <tf2/LinearMath/Quaternion.h>

#include <Eigen/Geometry>

#include "ros/sun_position/messages.h"
#include "sunlit/astronomy/refraction.h"

namespace sunlit::ros_interface {
namespace {

// Ten times as wide as sun and moon, so that they can be found on a screen.
constexpr double kMagnified = 10.0;

std_msgs::Header headerOf(const ros::Time& stamp) {
  std_msgs::Header header;
  header.frame_id = kMapFrame;
  header.stamp = stamp;
  return header;
}

/// The fields that messages of sun and moon have in common.
template <typename Message, typename Position>
Message placeOf(const Position& position, const ros::Time& stamp) {
  Message message;
  message.header = headerOf(stamp);
  message.azimuth = position.azimuth.rad();
  message.zenith = position.zenith().rad();
  message.elevation = position.elevation.rad();
  message.elevation_geometric = position.elevation_geometric.rad();
  message.right_ascension = position.right_ascension.rad();
  message.declination = position.declination.rad();
  const Eigen::Vector3d direction = position.direction().vector();
  message.direction.x = direction.x();
  message.direction.y = direction.y();
  message.direction.z = direction.z();
  return message;
}

template <typename Message>
geometry_msgs::TransformStamped pointing(const Message& body, const std::string& frame, double distance_m) {
  geometry_msgs::TransformStamped map_from_body;
  map_from_body.header = body.header;
  map_from_body.child_frame_id = frame;
  map_from_body.transform.translation.x = distance_m * body.direction.x;
  map_from_body.transform.translation.y = distance_m * body.direction.y;
  map_from_body.transform.translation.z = distance_m * body.direction.z;
  // A compass azimuth runs clockwise from north, a ROS yaw counter-clockwise from east; a positive pitch
  // looks down.
  tf2::Quaternion rotation;
  rotation.setRPY(0.0, -body.elevation, kPi / 2.0 - body.azimuth);
  map_from_body.transform.rotation.x = rotation.x();
  map_from_body.transform.rotation.y = rotation.y();
  map_from_body.transform.rotation.z = rotation.z();
  map_from_body.transform.rotation.w = rotation.w();
  return map_from_body;
}

template <typename Message>
visualization_msgs::Marker ball(const Message& body, const std::string& name, double distance_m) {
  visualization_msgs::Marker marker;
  marker.header = body.header;
  marker.ns = name;
  marker.type = visualization_msgs::Marker::SPHERE;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.position.x = distance_m * body.direction.x;
  marker.pose.position.y = distance_m * body.direction.y;
  marker.pose.position.z = distance_m * body.direction.z;
  marker.pose.orientation.w = 1.0;
  marker.color.a = 1.0f;
  return marker;
}

}  // namespace

SunPosition toMessage(const ComputedSun& sun, const ros::Time& stamp) {
  auto message = placeOf<SunPosition>(sun.position, stamp);
  message.hour_angle = sun.position.hour_angle.rad();
  message.distance_au = sun.coordinates.distance_au;
  message.equation_of_time = sun.coordinates.equation_of_time_s;
  return message;
}

MoonPosition toMessage(const astronomy::MoonPosition& moon, const ros::Time& stamp) {
  auto message = placeOf<MoonPosition>(moon, stamp);
  message.distance = moon.distance_m;
  message.angular_radius = moon.angularRadius().rad();
  message.phase_angle = moon.phase_angle.rad();
  message.illuminated_fraction = moon.illuminated_fraction;
  message.bright_limb_angle = moon.bright_limb.rad();
  return message;
}

geometry_msgs::QuaternionStamped toMessage(const Eigen::Matrix3d& map_from_celestial,
                                           const ros::Time& stamp) {
  const Eigen::Quaterniond rotation = Eigen::Quaterniond(map_from_celestial).normalized();
  geometry_msgs::QuaternionStamped message;
  message.header = headerOf(stamp);
  message.quaternion.x = rotation.x();
  message.quaternion.y = rotation.y();
  message.quaternion.z = rotation.z();
  message.quaternion.w = rotation.w();
  return message;
}

geometry_msgs::TransformStamped toTransform(const SunPosition& sun, const std::string& frame,
                                            double distance_m) {
  return pointing(sun, frame, distance_m);
}

geometry_msgs::TransformStamped toTransform(const MoonPosition& moon, const std::string& frame,
                                            double distance_m) {
  return pointing(moon, frame, distance_m);
}

geometry_msgs::TransformStamped toTransform(const geometry_msgs::QuaternionStamped& celestial,
                                            const std::string& frame) {
  geometry_msgs::TransformStamped map_from_celestial;
  map_from_celestial.header = celestial.header;
  map_from_celestial.child_frame_id = frame;
  map_from_celestial.transform.rotation = celestial.quaternion;
  return map_from_celestial;
}

visualization_msgs::Marker toMarker(const SunPosition& sun, const std::string& name, double distance_m) {
  visualization_msgs::Marker marker = ball(sun, name, distance_m);
  marker.scale.x = marker.scale.y = marker.scale.z =
      kMagnified * 2.0 * tan(astronomy::kSunRadius) * distance_m;
  const float brightness = sun.elevation > 0.0 ? 1.0f : 0.35f;
  marker.color.r = brightness;
  marker.color.g = 0.85f * brightness;
  marker.color.b = 0.3f * brightness;
  return marker;
}

visualization_msgs::Marker toMarker(const MoonPosition& moon, const std::string& name, double distance_m) {
  visualization_msgs::Marker marker = ball(moon, name, distance_m);
  marker.scale.x = marker.scale.y = marker.scale.z =
      kMagnified * 2.0 * std::tan(moon.angular_radius) * distance_m;
  const auto brightness = static_cast<float>(0.3 + 0.7 * moon.illuminated_fraction);
  marker.color.r = marker.color.g = marker.color.b = brightness;
  return marker;
}

}  // namespace sunlit::ros_interface
