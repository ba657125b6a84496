/// Between astronomy and the messages of the sun_position node: pure functions, no node needed.
#pragma once

#include <geometry_msgs/QuaternionStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <sunlit/GetMoonPosition.h>
#include <sunlit/GetSunPosition.h>
#include <sunlit/GetSunTimes.h>
#include <sunlit/MoonPosition.h>
#include <sunlit/SetDateTime.h>
#include <sunlit/SetSite.h>
#include <sunlit/SunPosition.h>
#include <visualization_msgs/Marker.h>

#include <string>

#include "sunlit/astronomy/moon_position.h"
#include "sunlit/astronomy/sun_position.h"
#include "sunlit/astronomy/sun_times.h"
#include "sunlit/ros/frame_names.h"

namespace sunlit::ros_interface {

/// A sun, computed but not yet sent. The moon's light and sidereal time need `coordinates` too.
struct ComputedSun {
  astronomy::SolarCoordinates coordinates;
  astronomy::SunPosition position;
};

ComputedSun computeSun(const Instant& instant, const astronomy::EarthRotation& earth, const Site& site,
                       const Air& air);

SunPosition toMessage(const ComputedSun& sun, const ros::Time& stamp);
MoonPosition toMessage(const astronomy::MoonPosition& moon, const ros::Time& stamp);
/// `map_from_celestial` is a rotation.
geometry_msgs::QuaternionStamped toMessage(const Eigen::Matrix3d& map_from_celestial, const ros::Time& stamp);

/// +X of `frame` points towards sun or moon, +Y is horizontal; its origin lies `distance_m` along +X.
geometry_msgs::TransformStamped toTransform(const SunPosition& sun, const std::string& frame,
                                            double distance_m);
geometry_msgs::TransformStamped toTransform(const MoonPosition& moon, const std::string& frame,
                                            double distance_m);
/// The axes of `frame` are those of J2000; its origin is that of `map`.
geometry_msgs::TransformStamped toTransform(const geometry_msgs::QuaternionStamped& celestial,
                                            const std::string& frame);

/// A ball at the origin of the sun's frame: yellow by day, dark when its centre is below the horizon.
visualization_msgs::Marker toMarker(const SunPosition& sun, const std::string& name, double distance_m);
/// The same of the moon: white when full, grey when new.
visualization_msgs::Marker toMarker(const MoonPosition& moon, const std::string& name, double distance_m);

/// The fields of a request, as they were typed. Throw std::invalid_argument naming field, value and range.
CivilDateTime dateTimeOf(const SetDateTime::Request& request);
Site siteOf(const SetSite::Request& request);
/// `refraction_at_horizon` of the air is left as it is in `air`.
Air airOf(const SetSite::Request& request, Air air);

/// Fills `response` from everything in `request`. Throws as above.
void answer(const GetSunPosition::Request& request, const ros::Time& stamp,
            GetSunPosition::Response* response);

void answer(const GetMoonPosition::Request& request, const ros::Time& stamp,
            GetMoonPosition::Response* response);

/// Fills `response`; of `air` the refraction at the horizon counts. Throws as above.
void answer(const GetSunTimes::Request& request, const Air& air, const astronomy::EarthRotation& earth,
            GetSunTimes::Response* response);

/// "2024-07-01 04:00:00.000 UTC+03:00".
std::string printed(const CivilDateTime& civil);

}  // namespace sunlit::ros_interface
