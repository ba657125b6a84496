/// What the services of the sun_position node answer: pure functions, no node needed.
#pragma once

#include <std_msgs/Header.h>
#include <sunlit/GetMoonPosition.h>
#include <sunlit/GetSunPosition.h>
#include <sunlit/GetSunTimes.h>

#include <string>

#include "ros/conversions/sky.h"

namespace sunlit::ros_interface {

ComputedSun computeSun(const Instant& instant, const astronomy::EarthRotation& earth, const Site& site,
                       const Air& air);

/// Where a delta_t that was given is more than a minute off that of the date, which `auto` takes: both, in
/// words. The moon of such a date is more than 0.01° off. Else empty.
std::string deltaTFault(const astronomy::EarthRotation& earth, const Instant& instant);

/// Fills `response` from everything in `request`; `header` names the ENU frame. Throws std::invalid_argument
/// naming field, value and range.
void answer(const GetSunPosition::Request& request, const std_msgs::Header& header,
            GetSunPosition::Response* response);

void answer(const GetMoonPosition::Request& request, const std_msgs::Header& header,
            GetMoonPosition::Response* response);

/// Fills `response`; of `air` the refraction at the horizon counts. Throws as above.
void answer(const GetSunTimes::Request& request, const Air& air, const astronomy::EarthRotation& earth,
            GetSunTimes::Response* response);

}  // namespace sunlit::ros_interface
