/// One sun on ROS, with the moon and the stars of its hour: topics, TF, markers, diagnostics and services.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <tf2_ros/transform_broadcaster.h>

#include "ros/conversions/requests.h"
#include "ros/steady.h"
#include "ros/sun_position/answers.h"
#include "ros/sun_position/options.h"
#include "ros/sun_position/sun_clock.h"

namespace sunlit::ros_interface {

/// Under the wall clock it publishes `publish_rate` times a second. Under /clock it does so too, and besides
/// for each time at which /clock stands still for a moment: who waits with the clock, as the render node does
/// that owns it, gets the sky of exactly that time, however fast or slow both are. Before the first /clock it
/// publishes the sky of its date_time, but with a `start_stamp` nothing, since that sky is of that stamp.
///
/// Publishes `sun`, `moon` and `celestial` (latched), TF from map to a frame of each, `sun_marker` and
/// `moon_marker` below `node`, all with one stamp; offers `set_date_time`, `set_site`, `get_sun_position`,
/// `get_moon_position` and `get_sun_times` below `private_node`. Driven by ros::spin().
class SunPositionNode {
 public:
  SunPositionNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                  const SunPositionOptions& options);

 private:
  bool onSetDateTime(SetDateTime::Request& request, SetDateTime::Response& response);
  bool onSetSite(SetSite::Request& request, SetSite::Response& response);
  bool onGetSunPosition(GetSunPosition::Request& request, GetSunPosition::Response& response);
  bool onGetMoonPosition(GetMoonPosition::Request& request, GetMoonPosition::Response& response);
  bool onGetSunTimes(GetSunTimes::Request& request, GetSunTimes::Response& response);
  void advertiseServices();
  void onClock(const ros::Time& now);
  void publish();
  ros::Time nextStamp();
  void describe(diagnostic_updater::DiagnosticStatusWrapper& status);
  /// Whether its date_time is that of a stamp alone, and no time has come yet that tells how far it is.
  bool waitsForTime() const;
  /// Of its date_time; empty: none. Says it, too.
  std::string warnOfDeltaT() const;
  /// What keeps a sun from moving that should; empty: nothing.
  std::string hindrance();

  SunPositionOptions options_;
  SunClock clock_;
  bool waiting_;      ///< for the first subscriber of the sun, before the clock starts
  Instant sun_time_;  ///< of what was published last
  SunPosition sun_;   ///< published last
  MoonPosition moon_;
  ros::Time now_;       ///< as last heard
  ros::Time last_now_;  ///< of what was published last
  ros::Time last_stamp_;
  ClockWatch watch_;
  Throttle limit_told_{60.0};

  ros::NodeHandle node_;
  ros::NodeHandle private_node_;
  ros::Publisher sun_publisher_;
  ros::Publisher moon_publisher_;
  ros::Publisher celestial_publisher_;
  ros::Publisher sun_marker_publisher_;
  ros::Publisher moon_marker_publisher_;
  tf2_ros::TransformBroadcaster transform_broadcaster_;
  diagnostic_updater::Updater diagnostics_;
  std::vector<ros::ServiceServer> services_;
  ros::Timer timer_;           ///< under the wall clock
  ros::Subscriber ros_clock_;  ///< else
  ros::SteadyTimer standing_;  ///< ends when /clock has stood still for long enough
  ros::SteadyTimer diagnostics_timer_;
};

}  // namespace sunlit::ros_interface
