/// One sun on ROS, with the moon and the stars of its hour: topics, TF, markers, diagnostics and services.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <tf2_ros/transform_broadcaster.h>

#include "ros/sun_position/messages.h"
#include "ros/sun_position/options.h"
#include "ros/sun_position/sun_clock.h"

namespace sunlit::ros_interface {

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
  void publish();
  ros::Time nextStamp(const ros::Time& now);
  void describe(diagnostic_updater::DiagnosticStatusWrapper& status);

  SunPositionOptions options_;
  SunClock clock_;
  bool waiting_;      ///< for the first subscriber of the sun, before the clock starts
  Instant sun_time_;  ///< of what was published last
  SunPosition sun_;   ///< published last
  MoonPosition moon_;
  ros::Time last_now_;
  ros::Time last_stamp_;

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
  ros::Timer timer_;
  ros::WallTimer jump_watch_;
};

}  // namespace sunlit::ros_interface
