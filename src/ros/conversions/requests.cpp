#include "ros/conversions/requests.h"

#include <cmath>

#include "sunlit/astronomy/civil_time.h"

namespace sunlit::ros_interface {

namespace {

template <typename Request>
Site checkedSite(const Request& request) {
  const Site site{Angle::degrees(request.latitude), Angle::degrees(request.longitude), request.elevation};
  requireFields(site);
  return site;
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
  requireFields(civil);         // the services know hours 0 to 23 only
  return civil;
}

template <typename Request>
SkyRequest skyOfRequest(const Request& request) {
  SkyRequest asked;
  asked.instant = astronomy::instantOf(civilOfRequest(request));
  asked.site = checkedSite(request);
  asked.air = {request.pressure, request.temperature, Angle::degrees(request.atmospheric_refraction)};
  requireFields(asked.air);
  asked.earth.delta_ut1_s = request.delta_ut1;
  if (!std::isnan(request.delta_t)) asked.earth.delta_t_s = request.delta_t;
  requireFields(asked.earth);
  return asked;
}

}  // namespace

CivilDateTime dateTimeOf(const SetDateTime::Request& request) {
  return civilOfRequest(request);
}

Site siteOf(const SetSite::Request& request) {
  return checkedSite(request);
}

Site siteOf(const GetSunTimes::Request& request) {
  return checkedSite(request);
}

Air airOf(const SetSite::Request& request, Air air) {
  air.pressure_hpa = request.pressure;
  air.temperature_c = request.temperature;
  requireFields(air);
  return air;
}

SkyRequest skyOf(const GetSunPosition::Request& request) {
  return skyOfRequest(request);
}

SkyRequest skyOf(const GetMoonPosition::Request& request) {
  return skyOfRequest(request);
}

astronomy::CivilDate dateOf(const GetSunTimes::Request& request) {
  const astronomy::CivilDate date{request.year, request.month, request.day, request.timezone};
  astronomy::midnightOf(date);  // throws unless there is such a day
  return date;
}

}  // namespace sunlit::ros_interface
