/// What people typed into a service request, as our types. Pure functions; all throw std::invalid_argument
/// naming field, value and range.
#pragma once

#include <sunlit/GetMoonPosition.h>
#include <sunlit/GetSunPosition.h>
#include <sunlit/GetSunTimes.h>
#include <sunlit/SetDateTime.h>
#include <sunlit/SetSite.h>

#include <string>

#include "sunlit/astronomy/solar_coordinates.h"
#include "sunlit/astronomy/sun_times.h"
#include "sunlit/quantity/instant.h"
#include "sunlit/quantity/site.h"

namespace sunlit::ros_interface {

/// What decides where sun and moon stand.
struct SkyRequest {
  Instant instant;
  Site site;
  Air air;
  astronomy::EarthRotation earth;
};

CivilDateTime dateTimeOf(const SetDateTime::Request& request);
Site siteOf(const SetSite::Request& request);
Site siteOf(const GetSunTimes::Request& request);
/// `refraction_at_horizon` of the air is left as it is in `air`.
Air airOf(const SetSite::Request& request, Air air);
SkyRequest skyOf(const GetSunPosition::Request& request);
SkyRequest skyOf(const GetMoonPosition::Request& request);
astronomy::CivilDate dateOf(const GetSunTimes::Request& request);

}  // namespace sunlit::ros_interface
