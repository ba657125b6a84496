/// Where sun, moon and stars of one condition stand, as it comes in.
#pragma once

#include <ros/node_handle.h>

#include <string>

#include "ros/render/sky_messages.h"
#include "ros/render/sky_moments.h"

namespace sunlit::ros_interface {

class SkyInput {
 public:
  /// Subscribes to `prefix`sun and, if there is a `night`, to `prefix`moon and `prefix`celestial.
  SkyInput(const ros::NodeHandle& node, const std::string& prefix, bool night);
  SkyInput(const SkyInput&) = delete;
  SkyInput& operator=(const SkyInput&) = delete;

  bool ready() const { return moments_.latest().has_value(); }
  /// What must come before ready(), in words; empty then.
  std::string missing() const;
  /// Only when ready().
  const SkyBodies& bodies() const { return *moments_.latest(); }
  /// Changes whenever anything in the sky moved.
  int version() const { return moments_.version(); }

 private:
  template <typename Message>
  struct Topic {
    std::string what;
    ros::Subscriber subscriber = {};
    bool heard = false;  ///< something that could be used
  };
  template <typename Message>
  void subscribe(ros::NodeHandle node, const std::string& name, Topic<Message>* topic);
  template <typename Message>
  void take(const Message& message, Topic<Message>* topic);

  SkyMoments moments_;
  Topic<SunPosition> sun_{"a sun"};
  Topic<MoonPosition> moon_{"a moon"};
  Topic<geometry_msgs::QuaternionStamped> celestial_{"the turn of the stars"};
};

}  // namespace sunlit::ros_interface
