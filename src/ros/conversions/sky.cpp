#include "ros/conversions/sky.h"

#include <tf2_eigen/tf2_eigen.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "ros/conversions/geometry.h"
#include "ros/conversions/time.h"
#include "sunlit/astronomy/refraction.h"
#include "sunlit/quantity/range.h"
#include "sunlit/quantity/site.h"

namespace sunlit::ros_interface {
namespace {

// Ten times as wide as sun and moon, so that they can be found on a screen.
constexpr double kMagnified = 10.0;

/// The fields that messages of sun and moon have in common.
template <typename Message, typename Position>
Message placeOf(const Position& position, const std_msgs::Header& header) {
  Message message;
  message.header = header;
  message.azimuth = position.azimuth.rad();
  message.zenith = position.zenith().rad();
  message.elevation = position.elevation.rad();
  message.elevation_geometric = position.elevation_geometric.rad();
  message.right_ascension = position.right_ascension.rad();
  message.declination = position.declination.rad();
  tf2::toMsg(position.direction().vector(), message.direction);
  return message;
}

template <typename Message>
geometry_msgs::TransformStamped pointing(const Message& body, const std::string& frame, double distance_m) {
  Eigen::Vector3d direction;
  tf2::fromMsg(body.direction, direction);
  // A compass azimuth runs clockwise from north, a ROS yaw counter-clockwise from east; a positive pitch
  // looks down.
  const Eigen::AngleAxisd yaw(kPi / 2.0 - body.azimuth, Eigen::Vector3d::UnitZ());
  const Eigen::AngleAxisd pitch(-body.elevation, Eigen::Vector3d::UnitY());
  return toTransform(Eigen::Translation3d(distance_m * direction) * yaw * pitch, body.header, frame);
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

void requireFrame(const std_msgs::Header& header, const std::string& map_frame) {
  if (header.frame_id != map_frame) refuse("frame_id", '"' + header.frame_id + '"', '"' + map_frame + '"');
}

void requireUnitLength(const char* field, double length) {
  if (!(std::abs(length - 1.0) < 1e-3)) refuse(field, "of length " + textOf(length), "of length 1");
}

Direction directionOf(const geometry_msgs::Vector3& message) {
  Eigen::Vector3d vector;
  tf2::fromMsg(message, vector);
  requireUnitLength("direction", vector.norm());
  return Direction(vector);
}

Direction geometricOf(const Direction& apparent, double elevation_geometric) {
  require("elevation_geometric", elevation_geometric, {-0.5 * kPi, 0.5 * kPi}, "rad");
  // 1.9 at the most; one that was left at 0 would light a high sun's sky as at dusk.
  constexpr double kMostRefraction_deg = 5.0;
  const double seen = apparent.elevation().rad();
  if (std::abs(elevation_geometric - seen) > kMostRefraction_deg * kRadPerDeg) {
    refuse("elevation_geometric", textOf(elevation_geometric) + " rad",
           "within " + textOf(kMostRefraction_deg) + " deg of that of direction, " + textOf(seen) + " rad");
  }
  return Direction(apparent.azimuth(), Angle::radians(elevation_geometric));
}

}  // namespace

SunPosition toMessage(const ComputedSun& sun, const std_msgs::Header& header) {
  auto message = placeOf<SunPosition>(sun.position, header);
  message.utc = toUtc(sun.instant);
  message.hour_angle = sun.position.hour_angle.rad();
  message.distance_au = sun.coordinates.distance_au;
  message.equation_of_time = sun.coordinates.equation_of_time_s;
  message.site_elevation = sun.site_elevation_m;
  return message;
}

MoonPosition toMessage(const ComputedMoon& moon, const std_msgs::Header& header) {
  const astronomy::MoonPosition& position = moon.position;
  auto message = placeOf<MoonPosition>(position, header);
  message.utc = toUtc(moon.instant);
  message.distance = position.distance_m;
  message.angular_radius = position.angularRadius().rad();
  message.phase_angle = position.phase_angle.rad();
  message.illuminated_fraction = position.illuminated_fraction;
  message.bright_limb_angle = position.bright_limb.rad();
  return message;
}

geometry_msgs::QuaternionStamped toMessage(const Eigen::Matrix3d& map_from_celestial,
                                           const std_msgs::Header& header) {
  const Eigen::Quaterniond rotation = Eigen::Quaterniond(map_from_celestial).normalized();
  geometry_msgs::QuaternionStamped message;
  message.header = header;
  message.quaternion = tf2::toMsg(rotation);
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

// The ranges are those of sky/atmosphere.h and sky/night.h.

sky::SunInSky fromMessage(const SunPosition& message, const std::string& map_frame) {
  requireFrame(message.header, map_frame);
  require("distance_au", message.distance_au, {0.97, 1.03}, "au");
  require("rate", message.rate, {});
  const Direction apparent = directionOf(message.direction);
  return {apparent, message.distance_au, geometricOf(apparent, message.elevation_geometric)};
}

double siteElevationOf(const SunPosition& message) {
  Site site;
  const std::vector<Field> rows = fieldsOf(site);
  fieldOf(rows, "elevation").set(message.site_elevation, "site_elevation");
  return site.elevation_m;
}

sky::MoonInSky fromMessage(const MoonPosition& message, const std::string& map_frame) {
  requireFrame(message.header, map_frame);
  require("distance", message.distance, {3.4e8, 4.2e8}, "m");
  require("phase_angle", message.phase_angle, {0.0, kPi}, "rad");
  sky::MoonInSky moon;
  moon.apparent = directionOf(message.direction);
  moon.geometric = geometricOf(moon.apparent, message.elevation_geometric);
  moon.distance_m = message.distance;
  moon.phase_angle = Angle::radians(message.phase_angle);
  return moon;
}

Eigen::Matrix3d fromMessage(const geometry_msgs::QuaternionStamped& message, const std::string& map_frame) {
  requireFrame(message.header, map_frame);
  Eigen::Quaterniond rotation;
  tf2::fromMsg(message.quaternion, rotation);
  requireUnitLength("quaternion", rotation.norm());
  return rotation.normalized().toRotationMatrix();
}

}  // namespace sunlit::ros_interface
