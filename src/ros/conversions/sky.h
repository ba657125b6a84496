/// Sun, moon and stars, to and from ROS messages. Pure functions.
#pragma once

#include <geometry_msgs/QuaternionStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <sunlit/MoonPosition.h>
#include <sunlit/SunPosition.h>
#include <visualization_msgs/Marker.h>

#include <string>

#include "sunlit/astronomy/moon_position.h"
#include "sunlit/astronomy/sun_position.h"
#include "sunlit/sky/atmosphere.h"

namespace sunlit::ros_interface {

/// A sun, computed but not yet sent. The moon's light and sidereal time need `coordinates` too.
struct ComputedSun {
  Instant instant;
  astronomy::SolarCoordinates coordinates;
  astronomy::SunPosition position;
  double site_elevation_m = 0.0;  ///< of the place that it is seen from
};

struct ComputedMoon {
  Instant instant;
  astronomy::MoonPosition position;
};

/// `header` names the ENU frame. Of a sun that stands still.
SunPosition toMessage(const ComputedSun& sun, const std_msgs::Header& header);
MoonPosition toMessage(const ComputedMoon& moon, const std_msgs::Header& header);
/// `map_from_celestial` is a rotation.
geometry_msgs::QuaternionStamped toMessage(const Eigen::Matrix3d& map_from_celestial,
                                           const std_msgs::Header& header);

/// +X of `frame` points towards sun or moon, +Y is horizontal; its origin lies `distance_m` along +X.
geometry_msgs::TransformStamped toTransform(const SunPosition& sun, const std::string& frame,
                                            double distance_m);
geometry_msgs::TransformStamped toTransform(const MoonPosition& moon, const std::string& frame,
                                            double distance_m);
/// The axes of `frame` are those of J2000; its origin is that of the parent.
geometry_msgs::TransformStamped toTransform(const geometry_msgs::QuaternionStamped& celestial,
                                            const std::string& frame);

/// A ball at the origin of the sun's frame: yellow by day, dark when its centre is below the horizon.
visualization_msgs::Marker toMarker(const SunPosition& sun, const std::string& name, double distance_m);
/// The same of the moon: white when full, grey when new.
visualization_msgs::Marker toMarker(const MoonPosition& moon, const std::string& name, double distance_m);

/// Throw std::invalid_argument saying what was wrong and what is wanted; `map_frame` is what the header must
/// name.
sky::SunInSky fromMessage(const SunPosition& message, const std::string& map_frame);
/// Of the place that the sun is seen from, m.
double siteElevationOf(const SunPosition& message);
sky::MoonInSky fromMessage(const MoonPosition& message, const std::string& map_frame);
/// map_from_celestial.
Eigen::Matrix3d fromMessage(const geometry_msgs::QuaternionStamped& message, const std::string& map_frame);

}  // namespace sunlit::ros_interface
