#include "ros/sun_position/options.h"

#include <stdexcept>

#include "sunlit/astronomy/civil_time.h"
#include "sunlit/astronomy/limits.h"

namespace sunlit::ros_interface {
namespace {

Range rangeOf(const astronomy::Limits& limits) {
  return {limits.min, limits.max};
}

/// Reads keys of one group whose last part is the name of the limits: ~site/latitude.
class GroupReader {
 public:
  GroupReader(const ParameterReader& parameters, const std::string& group)
      : parameters_(parameters), prefix_(group + "/") {}

  double number(const astronomy::Limits& limits, double fallback) const {
    return parameters_.number(prefix_ + limits.name, fallback, rangeOf(limits));
  }
  Angle degrees(const astronomy::Limits& limits, Angle fallback) const {
    return Angle::degrees(number(limits, fallback.deg()));
  }
  int integer(const astronomy::Limits& limits, int fallback) const {
    return parameters_.integer(prefix_ + limits.name, fallback, rangeOf(limits));
  }
  std::string fullName(const std::string& key) const { return parameters_.fullName(prefix_ + key); }
  const ParameterReader& all() const { return parameters_; }

 private:
  const ParameterReader& parameters_;
  std::string prefix_;
};

CivilDateTime readDateTime(const GroupReader& group, const CivilDateTime& fallback) {
  CivilDateTime civil;
  civil.year = group.integer(astronomy::kYearLimits, fallback.year);
  civil.month = group.integer(astronomy::kMonthLimits, fallback.month);
  civil.day = group.all().integer("date_time/day", fallback.day);
  civil.hour = group.integer(astronomy::kHourLimits, fallback.hour);
  civil.minute = group.integer(astronomy::kMinuteLimits, fallback.minute);
  civil.second = group.number(astronomy::kSecondLimits, fallback.second);
  civil.timezone = group.number(astronomy::kTimezoneLimits, fallback.timezone);
  // What no range of one field tells: 31 February, and second 60.
  std::string field = "day";
  try {
    astronomy::midnightOf({civil.year, civil.month, civil.day, civil.timezone});
    field = "second";
    astronomy::instantOf(civil);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument("parameter " + group.fullName(field) + ": " + error.what());
  }
  return civil;
}

}  // namespace

SunPositionOptions readSunPositionOptions(const ParameterReader& parameters) {
  SunPositionOptions options;
  const GroupReader date_time(parameters, "date_time");
  options.date_time = readDateTime(date_time, options.date_time);
  options.rate = date_time.number(astronomy::kRateLimits, options.rate);
  options.wait_for_subscriber = parameters.flag("date_time/wait_for_subscriber", options.wait_for_subscriber);

  const GroupReader site(parameters, "site");
  options.site.latitude = site.degrees(astronomy::kLatitudeLimits, options.site.latitude);
  options.site.longitude = site.degrees(astronomy::kLongitudeLimits, options.site.longitude);
  options.site.elevation_m = site.number(astronomy::kElevationLimits, options.site.elevation_m);

  const GroupReader air(parameters, "atmosphere");
  options.air.pressure_hpa = air.number(astronomy::kPressureLimits, options.air.pressure_hpa);
  options.air.temperature_c = air.number(astronomy::kTemperatureLimits, options.air.temperature_c);
  options.air.refraction_at_horizon =
      air.degrees(astronomy::kHorizonRefractionLimits, options.air.refraction_at_horizon);

  options.earth.delta_ut1_s =
      parameters.number("earth/delta_ut1", options.earth.delta_ut1_s, rangeOf(astronomy::kDeltaUt1Limits));
  options.earth.delta_t_s = parameters.numberOr("earth/delta_t", "auto", options.earth.delta_t_s,
                                                rangeOf(astronomy::kDeltaTLimits));
  options.publish_rate_hz = parameters.number("publish_rate", options.publish_rate_hz, {0.01, 1000.0});
  options.tf_distance_m = parameters.number("tf_distance", options.tf_distance_m, {0.001, 1e9});
  return options;
}

std::vector<NamedSun> readSuns(const ParameterReader& parameters) {
  parameters.value("diagnostic_period");  // belongs to diagnostic_updater, which reads it by itself
  std::vector<NamedSun> suns;
  for (const Condition& condition : readConditions(parameters)) {
    SunPositionOptions options = readSunPositionOptions(condition.parameters);
    condition.parameters.rejectUnknown();
    options.sun_frame = condition.frame(options.sun_frame);
    options.moon_frame = condition.frame(options.moon_frame);
    options.celestial_frame = condition.frame(options.celestial_frame);
    suns.push_back({condition, options});
  }
  parameters.rejectUnknown();
  return suns;
}

}  // namespace sunlit::ros_interface
