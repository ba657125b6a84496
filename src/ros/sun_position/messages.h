/// Between astronomy and the messages of the sun_position node: pure functions, no node needed.
#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <sunlit/GetSunPosition.h>
#include <sunlit/GetSunTimes.h>
#include <sunlit/SetDateTime.h>
#include <sunlit/SetSite.h>
#include <sunlit/SunPosition.h>
#include <visualization_msgs/Marker.h>

#include <string>

#include "sunlit/astronomy/sun_position.h"
#include "sunlit/astronomy/sun_times.h"
#include "sunlit/ros/frame_names.h"

namespace sunlit::ros_interface {

/// A sun, computed but not yet sent.
struct ComputedSun {
  astronomy::SolarCoordinates coordinates;
  astronomy::SunPosition position;
};

ComputedSun computeSun(const Instant& instant, const astronomy::EarthRotation& earth, const Site& site,
                       const Air& air);

SunPosition toMessage(const ComputedSun& sun, const ros::Time& stamp);

/// +X of `frame` points towards the sun, +Y is horizontal; its origin lies `distance_m` along +X.
geometry_msgs::TransformStamped toTransform(const SunPosition& sun, const std::string& frame,
                                            double distance_m);

/// A ball at the origin of the sun's frame: yellow by day, dark when its centre is below the horizon.
visualization_msgs::Marker toMarker(const SunPosition& sun, const std::string& name, double distance_m);

/// The fields of a request, as they were typed. Throw std::invalid_argument naming field, value and range.
CivilDateTime dateTimeOf(const SetDateTime::Request& request);
Site siteOf(const SetSite::Request& request);
/// `refraction_at_horizon` of the air is left as it is in `air`.
Air airOf(const SetSite::Request& request, Air air);

/// Fills `response` from everything in `request`. Throws as above.
void answer(const GetSunPosition::Request& request, const ros::Time& stamp,
            GetSunPosition::Response* response);

/// Fills `response`; of `air` the refraction at the horizon counts. Throws as above.
void answer(const GetSunTimes::Request& request, const Air& air, const astronomy::EarthRotation& earth,
            GetSunTimes::Response* response);

/// "2024-07-01 04:00:00.000 UTC+03:00".
std::string printed(const CivilDateTime& civil);

}  // namespace sunlit::ros_interface
