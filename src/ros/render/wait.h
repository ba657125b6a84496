/// What a run waits for.
#pragma once

#include <ros/time.h>

#include <string>
#include <utility>

#include "ros/conversions/time.h"
#include "ros/steady.h"

namespace sunlit::ros_interface {

/// In words, and by a key that stays as long as it is the same that is waited for: words may hold what
/// changes with each message.
struct Wait {
  Wait() = default;
  Wait(const std::string& words_) : Wait(words_, words_) {}
  Wait(std::string words_, std::string key_) : words(std::move(words_)), key(std::move(key_)) {}
  bool empty() const { return words.empty(); }

  std::string words;  ///< empty: nothing
  std::string key;
};

/// Tells when the wait for a time is worth a word.
class TimeWait {
 public:
  /// What is waited for until ROS time reaches `stamp`, which is that of `what`: nothing while `now` goes on
  /// and is within a few of `period` of it.
  Wait until(const ros::Time& stamp, const std::string& what, const ros::Duration& period) {
    constexpr double kFew = 3.0, kStill_s = 0.5;
    const ros::Time now = ros::Time::now();
    const bool stands = watch_.standsFor(now) > kStill_s;
    if (!stands && (stamp - now).toSec() <= kFew * period.toSec()) return {};
    return "ROS time to reach " + textOfStamp(stamp) + ", the stamp of " + what;
  }

 private:
  ClockWatch watch_;
};

}  // namespace sunlit::ros_interface
