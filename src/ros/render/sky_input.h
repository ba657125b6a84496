/// Where sun, moon and stars of one condition stand, as it comes in.
#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <optional>
#include <set>
#include <string>

#include "ros/conversions/sky.h"
#include "ros/render/sky_moments.h"
#include "ros/render/wait.h"

namespace sunlit::ros_interface {

/// Which topics to read, and how.
struct SkyInputOptions {
  std::string prefix;  ///< before sun, moon and celestial
  bool night = true;   ///< moon and stars too
  SkyRule rule = SkyRule::kAround;
  std::string map_frame;  ///< that all of them speak of
  /// Throws std::invalid_argument for a site, by its elevation, of which no sky can be made.
  std::function<void(double site_elevation_m)> require_site = [](double) {};
};

class SkyInput {
 public:
  SkyInput(const ros::NodeHandle& node, const SkyInputOptions& options);
  SkyInput(const SkyInput&) = delete;
  SkyInput& operator=(const SkyInput&) = delete;

  /// The newest whole moment; null before there is one.
  const SkyBodies* newest() const;
  /// What must come before there is one, in words; empty then.
  std::string missing() const;
  /// Messages that could not be used.
  std::size_t refused() const { return refused_; }
  /// Whether the latest of a topic was one of them.
  bool isRefusing() const { return sun_.refused || moon_.refused || celestial_.refused; }
  /// The topics on which the messages of several nodes that are still there came in turn, in words; empty if
  /// there are none.
  std::string mixedTopics() const;

  /// As SkyMoments has it.
  std::optional<SkyBodies> at(const ros::Time& stamp) const { return moments_.at(stamp); }
  bool missed(const ros::Time& stamp) const { return moments_.missed(stamp); }
  void forgetBefore(const ros::Time& stamp) { moments_.forgetBefore(stamp); }
  double spacing(const ros::Time& stamp) const { return moments_.spacing(stamp); }
  /// Of newest(), which is there.
  ros::Time newestStamp() const { return moments_.whole().rbegin()->first; }
  /// What must come before there is a sky of `stamp`; empty then.
  Wait missing(const ros::Time& stamp) const;

 private:
  template <typename Message>
  struct Topic {
    std::string what;
    ros::Subscriber subscriber = {};
    bool heard = false;       ///< something that could be used
    bool refused = false;     ///< the latest could not
    std::string sender = {};  ///< of the latest message
    std::set<std::string> senders = {};
    bool mixed = false;  ///< a sender came again after another one
  };
  template <typename Message>
  void subscribe(ros::NodeHandle node, const std::string& name, Topic<Message>* topic);
  template <typename Message>
  void take(const Message& message, Topic<Message>* topic);
  template <typename Message>
  void watchSender(const std::string& sender, Topic<Message>* topic);
  void put(const SunPosition& message);
  void put(const MoonPosition& message);
  void put(const geometry_msgs::QuaternionStamped& message);

  void requireSite(double site_elevation_m);

  SkyMoments moments_;
  std::string map_frame_;
  std::function<void(double)> require_site_;
  std::optional<double> site_elevation_m_;  ///< of the latest sun that could be used
  std::size_t refused_ = 0;
  Throttle refusals_{5.0};  ///< that are told of, by topic
  bool warned_of_senders_ = false;
  Topic<SunPosition> sun_{"a sun"};
  Topic<MoonPosition> moon_{"a moon"};
  Topic<geometry_msgs::QuaternionStamped> celestial_{"the turn of the stars"};
};

}  // namespace sunlit::ros_interface
