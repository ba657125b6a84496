#include "ros/sun_position/messages.h"

#include <tf2/LinearMath/Quaternion.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "sunlit/astronomy/civil_time.h"
#include "sunlit/astronomy/limits.h"
#include "sunlit/astronomy/refraction.h"

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

SunPosition toMessage(const ComputedSun& sun, const ros::Time& stamp) {
  SunPosition message;
  message.header.frame_id = kMapFrame;
  message.header.stamp = stamp;
  message.azimuth = sun.position.azimuth.rad();
  message.zenith = sun.position.zenith().rad();
  message.elevation = sun.position.elevation.rad();
  message.elevation_geometric = sun.position.elevation_geometric.rad();
  message.right_ascension = sun.position.right_ascension.rad();
  message.declination = sun.position.declination.rad();
  message.hour_angle = sun.position.hour_angle.rad();
  message.distance_au = sun.coordinates.distance_au;
  message.equation_of_time = sun.coordinates.equation_of_time_s;
  const Eigen::Vector3d direction = sun.position.direction().vector();
  message.direction.x = direction.x();
  message.direction.y = direction.y();
  message.direction.z = direction.z();
  return message;
}

geometry_msgs::TransformStamped toTransform(const SunPosition& sun, const std::string& frame,
                                            double distance_m) {
  geometry_msgs::TransformStamped map_from_sun;
  map_from_sun.header = sun.header;
  map_from_sun.child_frame_id = frame;
  map_from_sun.transform.translation.x = distance_m * sun.direction.x;
  map_from_sun.transform.translation.y = distance_m * sun.direction.y;
  map_from_sun.transform.translation.z = distance_m * sun.direction.z;
  // A compass azimuth runs clockwise from north, a ROS yaw counter-clockwise from east; a positive pitch
  // looks down.
  tf2::Quaternion rotation;
  rotation.setRPY(0.0, -sun.elevation, kPi / 2.0 - sun.azimuth);
  map_from_sun.transform.rotation.x = rotation.x();
  map_from_sun.transform.rotation.y = rotation.y();
  map_from_sun.transform.rotation.z = rotation.z();
  map_from_sun.transform.rotation.w = rotation.w();
  return map_from_sun;
}

visualization_msgs::Marker toMarker(const SunPosition& sun, const std::string& name, double distance_m) {
  visualization_msgs::Marker marker;
  marker.header = sun.header;
  marker.ns = name;
  marker.type = visualization_msgs::Marker::SPHERE;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.position.x = distance_m * sun.direction.x;
  marker.pose.position.y = distance_m * sun.direction.y;
  marker.pose.position.z = distance_m * sun.direction.z;
  marker.pose.orientation.w = 1.0;
  // Ten times as wide as the sun, so that it can be found on a screen.
  const double diameter_m = 10.0 * 2.0 * tan(astronomy::kSunRadius) * distance_m;
  marker.scale.x = marker.scale.y = marker.scale.z = diameter_m;
  const float brightness = sun.elevation > 0.0 ? 1.0f : 0.35f;
  marker.color.r = brightness;
  marker.color.g = 0.85f * brightness;
  marker.color.b = 0.3f * brightness;
  marker.color.a = 1.0f;
  return marker;
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
  const Instant instant = astronomy::instantOf(civilOfRequest(request));
  const Site site = checkedSite(request);
  const Air air{request.pressure, request.temperature, Angle::degrees(request.atmospheric_refraction)};
  astronomy::require(air);
  astronomy::require(astronomy::kDeltaUt1Limits, request.delta_ut1);
  astronomy::EarthRotation earth{request.delta_ut1, std::nullopt};
  if (!std::isnan(request.delta_t)) {
    astronomy::require(astronomy::kDeltaTLimits, request.delta_t);
    earth.delta_t_s = request.delta_t;
  }
  astronomy::require(astronomy::kSlopeLimits, request.slope);
  astronomy::require(astronomy::kAzmRotationLimits, request.azm_rotation);

  const ComputedSun sun = computeSun(instant, earth, site, air);
  response->position = toMessage(sun, stamp);
  response->incidence = astronomy::incidence(sun.position, {Angle::degrees(request.slope),
                                                            Angle::degrees(request.azm_rotation)})
                            .rad();
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
