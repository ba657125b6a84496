#include "ros/sun_position/sun_position_node.h"

#include <rosgraph_msgs/Clock.h>

#include <stdexcept>

#include "ros/conversions/geometry.h"
#include "ros/conversions/time.h"
#include "sunlit/astronomy/celestial.h"
#include "sunlit/astronomy/civil_time.h"
#include "sunlit/astronomy/delta_t.h"
#include "sunlit/ros/topic_names.h"
#include "sunlit/sky/eclipse.h"

namespace sunlit::ros_interface {
namespace {

constexpr char kPolynomials[] = "from the polynomials of Espenak and Meeus (2006)";
/// Of sun, moon and stars none may be lost where a reader is slow.
constexpr std::uint32_t kQueueSize = 10000;
/// /clock stands still, and does not only take its time from one value to the next.
const ros::WallDuration kStandstill(0.005);

void tellEclipses(const sky::SunInSky& sun, const sky::MoonInSky& moon,
                  diagnostic_updater::DiagnosticStatusWrapper* status) {
  status->addf("sun, fraction that the moon covers", "%.4f",
               1.0 - sky::uncoveredArea(sky::sunBehindMoon(sun, moon)));
  status->addf("moon, fraction of its light lost to the Earth's shadow", "%.4f",
               1.0 - sky::sunlightOnMoon(sun, moon));
}

/// A bad request changes nothing and is answered in words.
template <typename Response, typename Action>
bool answered(Response& response, const Action& action) {
  try {
    response.message = action();
    response.success = true;
  } catch (const std::invalid_argument& error) {
    response = Response();
    response.message = error.what();
  }
  return true;
}

}  // namespace

SunPositionNode::SunPositionNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                                 const SunPositionOptions& options)
    : options_(options),
      clock_(astronomy::instantOf(options.date_time), options.rate,
             options.start_stamp_s ? std::optional<ros::Time>(*options.start_stamp_s) : std::nullopt),
      waiting_(options.wait_for_subscriber),
      node_(node),
      private_node_(private_node),
      sun_publisher_(node_.advertise<SunPosition>(topics::kSun, kQueueSize, true)),
      moon_publisher_(node_.advertise<MoonPosition>(topics::kMoon, kQueueSize, true)),
      celestial_publisher_(
          node_.advertise<geometry_msgs::QuaternionStamped>(topics::kCelestial, kQueueSize, true)),
      sun_marker_publisher_(node_.advertise<visualization_msgs::Marker>(topics::kSunMarker, 10, true)),
      moon_marker_publisher_(node_.advertise<visualization_msgs::Marker>(topics::kMoonMarker, 10, true)),
      diagnostics_(node, ros::NodeHandle("~"), private_node.getNamespace()) {
  diagnostics_.setHardwareID("none");
  diagnostics_.add("sun", this, &SunPositionNode::describe);
  advertiseServices();
  ROS_INFO("%s starts at %s, rate %g, at latitude %g, longitude %g; delta_t %s", options_.sun_frame.c_str(),
           textOfDate(astronomy::instantOf(options_.date_time), options_.date_time.timezone).c_str(),
           options_.rate, options_.site.latitude.deg(), options_.site.longitude.deg(),
           options_.earth.delta_t_s ? "as given" : kPolynomials);
  warnOfDeltaT();
  now_ = ros::Time::now();
  publish();
  if (ros::Time::isSimTime()) {
    standing_ = node_.createSteadyTimer(
        kStandstill, [this](const ros::SteadyTimerEvent&) { publish(); }, true, false);
    const boost::function<void(const rosgraph_msgs::ClockConstPtr&)> heard =
        [this](const rosgraph_msgs::ClockConstPtr& clock) { onClock(clock->clock); };
    ros_clock_ = node_.subscribe<rosgraph_msgs::Clock>(topics::kClock, 1000, heard);
  } else {
    timer_ = node_.createTimer(ros::Duration(1.0 / options_.publish_rate_hz), [this](const ros::TimerEvent&) {
      now_ = ros::Time::now();
      publish();
    });
  }
  // By no clock that somebody can stop or set: a stopped /clock is worth a diagnosis too.
  diagnostics_timer_ =
      node_.createSteadyTimer(ros::WallDuration(diagnostics_.getPeriod()),
                              [this](const ros::SteadyTimerEvent&) { diagnostics_.force_update(); });
}

void SunPositionNode::onClock(const ros::Time& now) {
  if (now == now_) return;
  standing_.stop();
  now_ = now;
  watch_.standsFor(now_);
  const bool jumped_back = now_ < last_now_;
  if (jumped_back || secondsFrom(last_now_, now_) >= 1.0 / options_.publish_rate_hz) return publish();
  standing_.start();
}

void SunPositionNode::advertiseServices() {
  services_ = {private_node_.advertiseService("set_date_time", &SunPositionNode::onSetDateTime, this),
               private_node_.advertiseService("set_site", &SunPositionNode::onSetSite, this),
               private_node_.advertiseService("get_sun_position", &SunPositionNode::onGetSunPosition, this),
               private_node_.advertiseService("get_moon_position", &SunPositionNode::onGetMoonPosition, this),
               private_node_.advertiseService("get_sun_times", &SunPositionNode::onGetSunTimes, this)};
}

ros::Time SunPositionNode::nextStamp() {
  // TF ignores a second transform of one stamp. Where ROS time stands still, a new sun is 1 ns younger than
  // the last.
  last_stamp_ = now_ == last_now_ ? last_stamp_ + ros::Duration(0, 1) : now_;
  last_now_ = now_;
  return last_stamp_;
}

bool SunPositionNode::waitsForTime() const {
  return now_.isZero() && options_.start_stamp_s && clock_.rate() != 0.0;
}

void SunPositionNode::publish() {
  if (waitsForTime()) return;
  waiting_ = waiting_ && sun_publisher_.getNumSubscribers() == 0;
  sun_time_ = clock_.at(waiting_ ? ros::Time() : now_);
  const std_msgs::Header header = headerOf(options_.map_frame, nextStamp());
  const ComputedSun sun = computeSun(sun_time_, options_.earth, options_.site, options_.air);
  sun_ = toMessage(sun, header);
  sun_.rate = waiting_ ? 0.0 : clock_.rate();
  const astronomy::LunarCoordinates moon = astronomy::lunarCoordinates(sun_time_, options_.earth);
  moon_ = toMessage(
      ComputedMoon{sun_time_, astronomy::moonPosition(moon, sun.coordinates, options_.site, options_.air)},
      header);
  const geometry_msgs::QuaternionStamped celestial =
      toMessage(astronomy::mapFromCelestial(sun_time_, options_.earth, options_.site), header);
  // The sun last: who has it, as a rule has moon and stars of its hour too.
  moon_publisher_.publish(moon_);
  celestial_publisher_.publish(celestial);
  sun_publisher_.publish(sun_);
  transform_broadcaster_.sendTransform({toTransform(sun_, options_.sun_frame, options_.tf_distance_m),
                                        toTransform(moon_, options_.moon_frame, options_.tf_distance_m),
                                        toTransform(celestial, options_.celestial_frame)});
  sun_marker_publisher_.publish(toMarker(sun_, options_.sun_frame, options_.tf_distance_m));
  moon_marker_publisher_.publish(toMarker(moon_, options_.moon_frame, options_.tf_distance_m));
  if (clock_.atLimit() && limit_told_.isTime()) {
    ROS_ERROR("The clock of %s has left the years %g to %g; it is held there", options_.sun_frame.c_str(),
              kYears.low, kYears.high);
  }
}

bool SunPositionNode::onSetDateTime(SetDateTime::Request& request, SetDateTime::Response& response) {
  return answered(response, [&] {
    const CivilDateTime civil = dateTimeOf(request);
    require("rate", request.rate, kRates, "s/s");
    if (!ros::Time::isSimTime()) now_ = ros::Time::now();
    clock_ = SunClock(astronomy::instantOf(civil), request.rate);
    options_.date_time = civil;
    options_.start_stamp_s.reset();
    publish();
    const std::string warning = warnOfDeltaT();
    return "the sun's clock is set to " + textOfDate(astronomy::instantOf(civil), civil.timezone) +
           ", rate " + textOf(request.rate) + (warning.empty() ? "" : "; " + warning);
  });
}

bool SunPositionNode::onSetSite(SetSite::Request& request, SetSite::Response& response) {
  return answered(response, [&] {
    const Site site = siteOf(request);
    const Air air = airOf(request, options_.air);
    options_.site = site;
    options_.air = air;
    if (!ros::Time::isSimTime()) now_ = ros::Time::now();
    publish();
    return "the scene is moved to latitude " + textOf(site.latitude.deg()) + " deg, longitude " +
           textOf(site.longitude.deg()) + " deg, elevation " + textOf(site.elevation_m) + " m, with air of " +
           textOf(air.pressure_hpa) + " hPa, " + textOf(air.temperature_c) + " deg C";
  });
}

bool SunPositionNode::onGetSunPosition(GetSunPosition::Request& request, GetSunPosition::Response& response) {
  return answered(response, [&] {
    answer(request, headerOf(options_.map_frame, ros::Time::now()), &response);
    return std::string();
  });
}

bool SunPositionNode::onGetMoonPosition(GetMoonPosition::Request& request,
                                        GetMoonPosition::Response& response) {
  return answered(response, [&] {
    answer(request, headerOf(options_.map_frame, ros::Time::now()), &response);
    return std::string();
  });
}

bool SunPositionNode::onGetSunTimes(GetSunTimes::Request& request, GetSunTimes::Response& response) {
  return answered(response, [&] {
    // A given delta_t belongs to the node's own date; the request may be of any year.
    answer(request, options_.air, {options_.earth.delta_ut1_s, std::nullopt}, &response);
    return std::string();
  });
}

std::string SunPositionNode::warnOfDeltaT() const {
  const std::string fault = deltaTFault(options_.earth, astronomy::instantOf(options_.date_time));
  if (!fault.empty())
    ROS_WARN("%s at %s: %s", options_.sun_frame.c_str(),
             textOfDate(astronomy::instantOf(options_.date_time), options_.date_time.timezone).c_str(),
             fault.c_str());
  return fault;
}

std::string SunPositionNode::hindrance() {
  constexpr double kStill_s = 3.0;
  if (!ros::Time::isSimTime() || clock_.rate() == 0.0 || waiting_) return std::string();
  if (waitsForTime())
    return "no sun is published before a time comes on /clock, since it depends on start_stamp";
  if (now_.isZero())
    return "the sun stands still, since no time comes on /clock, by which /use_sim_time tells to go";
  if (watch_.standsFor(now_) <= kStill_s) return std::string();
  return "the sun stands still, since /clock stands at " + textOfStamp(now_);
}

void SunPositionNode::describe(diagnostic_updater::DiagnosticStatusWrapper& status) {
  const std::string hindered = hindrance();
  if (clock_.atLimit()) {
    status.summary(diagnostic_msgs::DiagnosticStatus::ERROR,
                   "the clock is held at the end of the supported years");
  } else if (!hindered.empty()) {
    status.summary(diagnostic_msgs::DiagnosticStatus::WARN, hindered);
  } else {
    const char* motion = clock_.rate() == 0.0 ? "the sun stands still" : "the sun moves";
    status.summary(diagnostic_msgs::DiagnosticStatus::OK,
                   waiting_ ? "the sun waits for its first subscriber" : motion);
  }
  if (waitsForTime()) return;
  const std::string delta_t_fault = deltaTFault(options_.earth, sun_time_);
  if (!delta_t_fault.empty()) status.mergeSummary(diagnostic_msgs::DiagnosticStatus::WARN, delta_t_fault);
  status.add("date and time", textOfDate(sun_time_, options_.date_time.timezone));
  status.addf("rate", "%g", clock_.rate());
  status.addf("azimuth, deg", "%.6f", sun_.azimuth / kRadPerDeg);
  status.addf("apparent elevation, deg", "%.6f", sun_.elevation / kRadPerDeg);
  status.addf("moon's azimuth, deg", "%.6f", moon_.azimuth / kRadPerDeg);
  status.addf("moon's apparent elevation, deg", "%.6f", moon_.elevation / kRadPerDeg);
  status.addf("moon, lit fraction", "%.4f", moon_.illuminated_fraction);
  if (!sun_.header.frame_id.empty())
    tellEclipses(fromMessage(sun_, options_.map_frame), fromMessage(moon_, options_.map_frame), &status);
  status.addf("latitude, deg", "%.6f", options_.site.latitude.deg());
  status.addf("longitude, deg", "%.6f", options_.site.longitude.deg());
  if (options_.earth.delta_t_s) {
    status.addf("delta_t, s", "%.3f, as given", *options_.earth.delta_t_s);
  } else {
    status.addf("delta_t, s", "%.3f, %s", astronomy::deltaT(sun_time_), kPolynomials);
  }
}

}  // namespace sunlit::ros_interface
