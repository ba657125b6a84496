/// /diagnostics by the wall clock.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>

#include <string>

namespace sunlit::ros_interface {

/// A diagnostic_updater::Updater by itself goes by ROS time, and simulation time may stand still just when
/// there is something to tell.
class WallUpdater {
 public:
  using Status = diagnostic_updater::DiagnosticStatusWrapper;

  WallUpdater(const ros::NodeHandle& node, const ros::NodeHandle& private_node)
      : updater_(node, private_node) {
    updater_.setHardwareID("none");
  }

  /// From now on `tell` fills in the status of this part.
  void add(const std::string& part, const boost::function<void(Status&)>& tell) { updater_.add(part, tell); }
  /// Publishes if it never did, or ~diagnostic_period has passed since.
  void update() {
    const ros::SteadyTime now = ros::SteadyTime::now();
    if (!published_.isZero() && (now - published_).toSec() < updater_.getPeriod()) return;
    published_ = now;
    updater_.force_update();
  }

 private:
  diagnostic_updater::Updater updater_;
  ros::SteadyTime published_;
};

}  // namespace sunlit::ros_interface
