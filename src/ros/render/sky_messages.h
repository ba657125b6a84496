/// From the messages of the sun_position node to what is in the sky. Pure functions. All throw
/// std::invalid_argument saying what was wrong and what is wanted.
#pragma once

#include <geometry_msgs/QuaternionStamped.h>

#include "sunlit/MoonPosition.h"
#include "sunlit/SunPosition.h"
#include "sunlit/sky/atmosphere.h"

namespace sunlit::ros_interface {

sky::SunInSky fromMessage(const SunPosition& message);
sky::MoonInSky fromMessage(const MoonPosition& message);
/// map_from_celestial.
Eigen::Matrix3d fromMessage(const geometry_msgs::QuaternionStamped& message);

}  // namespace sunlit::ros_interface
