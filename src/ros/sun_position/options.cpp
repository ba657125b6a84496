#include "ros/sun_position/options.h"

#include <stdexcept>

#include "ros/sun_position/sun_clock.h"
#include "sunlit/astronomy/civil_time.h"
#include "sunlit/ros/node_rows.h"

namespace sunlit::ros_interface {
namespace {

std::vector<Field> framesOf(SunPositionOptions& options) {
  return {{"map", &options.map_frame, "", {}, "TF frame of the site: x east, y north, z up"},
          {"sun", &options.sun_frame, "", {}, "TF frame whose x points at the sun"},
          {"moon", &options.moon_frame, "", {}, "TF frame whose x points at the moon"},
          {"celestial", &options.celestial_frame, "", {}, "TF frame of the stars, J2000"}};
}

}  // namespace

std::vector<Field> fieldsOf(SunPositionOptions& options) {
  return joined(
      {under("date_time", fieldsOf(options.date_time)),
       {{"date_time/rate", &options.rate, "s/s", kRates, "of sun time to ROS time; 0 freezes the sun"},
        {"date_time/start_stamp",
         NumberOrWord{&options.start_stamp_s, "now"},
         "s",
         {0.001, 2147483647},
         "ROS time at which the clock shows date_time; now: the first that the node hears of"},
        {"date_time/wait_for_subscriber",
         &options.wait_for_subscriber,
         "",
         {},
         "the clock starts with the first subscriber of sun, and until then stands at date_time"}},
       under("site", fieldsOf(options.site)),
       under("atmosphere", fieldsOf(options.air)),
       under("earth", fieldsOf(options.earth)),
       {{"publish_rate", &options.publish_rate_hz, "Hz", {0.01, 1000}, "of ROS time"},
        {"tf_distance",
         &options.tf_distance_m,
         "m",
         {0.001, 1e9},
         "from the origin of map to those of the frames sun and moon"}},
       under("frames", framesOf(options))});
}

std::vector<Field> fieldsOfNode(double* diagnostic_period_s) {
  return {conditionsRow(), diagnosticPeriodRow(diagnostic_period_s)};
}

SunPositionOptions readSunPositionOptions(const ParameterReader& parameters) {
  SunPositionOptions options;
  parameters.read(fieldsOf(options));
  // What no range of one field tells: 31 February.
  parameters.check("date_time", [&] { astronomy::instantOf(options.date_time); });
  requireFrameNames(parameters, under("frames", framesOf(options)));
  if (options.wait_for_subscriber && options.start_stamp_s) {
    throw std::invalid_argument("parameters " + parameters.fullName("date_time/start_stamp") + " and " +
                                parameters.fullName("date_time/wait_for_subscriber") +
                                " are both given, but the clock has one start");
  }
  return options;
}

std::vector<NamedSun> readSuns(const ParameterReader& parameters) {
  double diagnostic_period_s = 1.0;
  parameters.read(fieldsOfNode(&diagnostic_period_s));
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
