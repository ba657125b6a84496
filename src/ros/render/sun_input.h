/// The sun of one condition, as it comes in.
#pragma once

#include <ros/node_handle.h>

#include <optional>
#include <string>

#include "sunlit/SunPosition.h"
#include "sunlit/sky/atmosphere.h"

namespace sunlit::ros_interface {

/// Keeps the latest sun and the daylight that belongs to it, which is computed anew only when the sun has
/// moved.
class SunInput {
 public:
  /// Subscribes to `topic`. `atmosphere` outlives this.
  SunInput(ros::NodeHandle node, const std::string& topic, const sky::Atmosphere& atmosphere);

  bool ready() const { return latest_.has_value(); }
  std::string topic() const { return subscriber_.getTopic(); }
  /// Both only when ready().
  const sky::SunInSky& sun() const { return *latest_; }
  const sky::Daylight& daylight();

 private:
  void onSun(const SunPosition& message);

  const sky::Atmosphere& atmosphere_;
  std::optional<sky::SunInSky> latest_;
  std::optional<sky::Daylight> daylight_;  // of latest_, once somebody asked for it
  ros::Subscriber subscriber_;
};

}  // namespace sunlit::ros_interface
