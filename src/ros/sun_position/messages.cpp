#include "ros/sun_position/messages.h"

#include <cmath>
#include <cstdio>
#include <limits>

#include "sunlit/astronomy/civil_time.h"
#include "sunlit/astronomy/limits.h"

namespace sunlit::ros_interface {
namespace {

template <typename Request>
Site checkedSite(const Request& request) {
  astronomy::require(astronomy::kLatitudeLimits, request.latitude);
  astronomy::require(astronomy::kLongitudeLimits, request.longitude);
  astronomy::require(astronomy::kElevationLimits, request.elevation);
  return {Angle::degrees(request.latitude), Angle::degrees(request.longitude), request.elevation};
}

template <typename Request>
CivilDateTime civilOfRequest(const Request& request) {
  CivilDateTime civil;
  civil.year = request.year;
  civil.month = request.month;
  civil.day = request.day;
  civil.hour = request.hour;
  civil.minute = request.minute;
  civil.second = request.second;
  civil.timezone = request.timezone;
  astronomy::instantOf(civil);  // throws unless all of it is possible
  if (civil.hour == 24)
    astronomy::require(astronomy::kHourLimits, civil.hour);  // the services know 0 to 23 only
  return civil;
}

/// What decides where sun and moon stand.
struct Asked {
  Instant instant;
  Site site;
  Air air;
  astronomy::EarthRotation earth;
};

template <typename Request>
Asked askedBy(const Request& request) {
  Asked asked;
  asked.instant = astronomy::instantOf(civilOfRequest(request));
  asked.site = checkedSite(request);
  asked.air = {request.pressure, request.temperature, Angle::degrees(request.atmospheric_refraction)};
  astronomy::require(asked.air);
  astronomy::require(astronomy::kDeltaUt1Limits, request.delta_ut1);
  asked.earth.delta_ut1_s = request.delta_ut1;
  if (!std::isnan(request.delta_t)) {
    astronomy::require(astronomy::kDeltaTLimits, request.delta_t);
    asked.earth.delta_t_s = request.delta_t;
  }
  return asked;
}

double orNan(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

const char* nameOf(astronomy::SunState state) {
  switch (state) {
    case astronomy::SunState::kPolarDay:
      return "polar_day";
    case astronomy::SunState::kPolarNight:
      return "polar_night";
    case astronomy::SunState::kNormal:
      break;
  }
  return "normal";
}

}  // namespace

ComputedSun computeSun(const Instant& instant, const astronomy::EarthRotation& earth, const Site& site,
                       const Air& air) {
  const astronomy::SolarCoordinates coordinates = astronomy::solarCoordinates(instant, earth);
  return {coordinates, astronomy::sunPosition(coordinates, site, air)};
}

CivilDateTime dateTimeOf(const SetDateTime::Request& request) {
  return civilOfRequest(request);
}

Site siteOf(const SetSite::Request& request) {
  return checkedSite(request);
}

Air airOf(const SetSite::Request& request, Air air) {
  air.pressure_hpa = request.pressure;
  air.temperature_c = request.temperature;
  astronomy::require(air);
  return air;
}

void answer(const GetSunPosition::Request& request, const ros::Time& stamp,
            GetSunPosition::Response* response) {
  const Asked asked = askedBy(request);
  astronomy::require(astronomy::kSlopeLimits, request.slope);
  astronomy::require(astronomy::kAzmRotationLimits, request.azm_rotation);

  const ComputedSun sun = computeSun(asked.instant, asked.earth, asked.site, asked.air);
  response->position = toMessage(sun, stamp);
  response->incidence = astronomy::incidence(sun.position, {Angle::degrees(request.slope),
                                                            Angle::degrees(request.azm_rotation)})
                            .rad();
}

void answer(const GetMoonPosition::Request& request, const ros::Time& stamp,
            GetMoonPosition::Response* response) {
  const Asked asked = askedBy(request);
  response->position =
      toMessage(astronomy::moonPosition(asked.instant, asked.earth, asked.site, asked.air), stamp);
}

void answer(const GetSunTimes::Request& request, const Air& air, const astronomy::EarthRotation& earth,
            GetSunTimes::Response* response) {
  const astronomy::CivilDate date{request.year, request.month, request.day, request.timezone};
  astronomy::midnightOf(date);  // the date is checked before the place, as it stands in the request
  const astronomy::SunTimes times = astronomy::sunTimes(date, checkedSite(request), air, earth);
  response->sun_state = nameOf(times.state);
  response->sunrise = orNan(times.horizon.dawn);
  response->transit = orNan(times.transit);
  response->sunset = orNan(times.horizon.dusk);
  response->civil_dawn = orNan(times.civil.dawn);
  response->civil_dusk = orNan(times.civil.dusk);
  response->nautical_dawn = orNan(times.nautical.dawn);
  response->nautical_dusk = orNan(times.nautical.dusk);
  response->astronomical_dawn = orNan(times.astronomical.dawn);
  response->astronomical_dusk = orNan(times.astronomical.dusk);
}

std::string printed(const CivilDateTime& civil) {
  const long minutes = std::lround(std::abs(civil.timezone) * 60.0);
  char text[96];
  std::snprintf(text, sizeof(text), "%d-%02d-%02d %02d:%02d:%06.3f UTC%c%02ld:%02ld", civil.year, civil.month,
                civil.day, civil.hour, civil.minute, civil.second, civil.timezone < 0.0 ? '-' : '+',
                minutes / 60, minutes % 60);
  return text;
}

}  // namespace sunlit::ros_interface
