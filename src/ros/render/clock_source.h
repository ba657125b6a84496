/// The time of the whole system, where the renderer owns it.
#pragma once

#include <ros/node_handle.h>

#include <condition_variable>
#include <mutex>
#include <thread>

namespace sunlit::ros_interface {

/// Publishes /clock: each new time at once, and the present one every 0.1 s of wall time, so that whoever
/// comes late gets it too. It goes on while the owner loads or renders, and never goes back.
class ClockSource {
 public:
  /// `time` is after 0. Throws std::invalid_argument where nodes do not go by /clock (/use_sim_time), or
  /// somebody else publishes it.
  ClockSource(ros::NodeHandle node, const ros::Time& time);
  ~ClockSource();
  ClockSource(const ClockSource&) = delete;
  ClockSource& operator=(const ClockSource&) = delete;

  /// Nothing happens where `time` is not later than the present one.
  void advanceTo(const ros::Time& time);
  /// Nothing is published any more, and the master forgets /use_sim_time: nodes that start on it later go by
  /// the wall clock again.
  void stop();

 private:
  void repeat();
  void publish();

  ros::Publisher publisher_;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool ends_ = false;
  ros::Time time_;
  std::thread thread_;  // the last member: it uses all others
};

/// Of a node that publishes the time, or was to and could not begin: the master forgets /use_sim_time, so
/// that nodes that start on it later do not wait for ever. Not where somebody else publishes /clock.
void takeBackSimTime();

}  // namespace sunlit::ros_interface
