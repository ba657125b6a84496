#include "ros/sun_position/answers.h"

#include <cmath>
#include <limits>

#include "ros/conversions/requests.h"
#include "sunlit/astronomy/delta_t.h"

namespace sunlit::ros_interface {
namespace {

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

/// s: polynomials are a few off today's, and differ by so much by 2060.
constexpr double kFarOff_s = 60.0;

}  // namespace

std::string deltaTFault(const astronomy::EarthRotation& earth, const Instant& instant) {
  if (!earth.delta_t_s) return std::string();
  const double of_date_s = astronomy::deltaT(instant);
  if (std::abs(*earth.delta_t_s - of_date_s) <= kFarOff_s) return std::string();
  return "delta_t is " + textOf(*earth.delta_t_s) + " s, as given, but of that date it is about " +
         textOf(std::round(of_date_s)) + " s, which auto takes";
}

ComputedSun computeSun(const Instant& instant, const astronomy::EarthRotation& earth, const Site& site,
                       const Air& air) {
  const astronomy::SolarCoordinates coordinates = astronomy::solarCoordinates(instant, earth);
  return {instant, coordinates, astronomy::sunPosition(coordinates, site, air), site.elevation_m};
}

void answer(const GetSunPosition::Request& request, const std_msgs::Header& header,
            GetSunPosition::Response* response) {
  const SkyRequest asked = skyOf(request);
  const astronomy::Surface surface{Angle::degrees(request.slope), Angle::degrees(request.azm_rotation)};
  requireFields(surface);

  const ComputedSun sun = computeSun(asked.instant, asked.earth, asked.site, asked.air);
  response->position = toMessage(sun, header);
  response->incidence = astronomy::incidence(sun.position, surface).rad();
}

void answer(const GetMoonPosition::Request& request, const std_msgs::Header& header,
            GetMoonPosition::Response* response) {
  const SkyRequest asked = skyOf(request);
  response->position = toMessage(
      ComputedMoon{asked.instant, astronomy::moonPosition(asked.instant, asked.earth, asked.site, asked.air)},
      header);
}

void answer(const GetSunTimes::Request& request, const Air& air, const astronomy::EarthRotation& earth,
            GetSunTimes::Response* response) {
  const astronomy::CivilDate date = dateOf(request);  // checked before the place, as it stands in the request
  const astronomy::SunTimes times = astronomy::sunTimes(date, siteOf(request), air, earth);
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

}  // namespace sunlit::ros_interface
