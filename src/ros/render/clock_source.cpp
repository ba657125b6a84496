#include "ros/render/clock_source.h"

#include <ros/master.h>
#include <ros/param.h>
#include <ros/this_node.h>
#include <rosgraph_msgs/Clock.h>

#include <chrono>
#include <stdexcept>
#include <string>

#include "sunlit/ros/topic_names.h"

namespace sunlit::ros_interface {

namespace {

constexpr std::chrono::milliseconds kPeriod(100);
const char* const kSimTime = "/use_sim_time";

/// Of a master that does not answer: whether it is waited for.
enum class Silence { kIsWaitedFor, kIsNoAnswer };

/// A node other than this one that publishes `topic`; empty if there is none, or none is told of.
std::string otherPublisher(const std::string& topic, Silence silence) {
  XmlRpc::XmlRpcValue request, response, state;
  request[0] = ros::this_node::getName();
  if (!ros::master::execute("getSystemState", request, response, state, silence == Silence::kIsWaitedFor))
    return std::string();
  for (int i = 0; i < state[0].size(); ++i) {
    if (static_cast<std::string>(state[0][i][0]) != topic) continue;
    for (int k = 0; k < state[0][i][1].size(); ++k) {
      const std::string publisher = state[0][i][1][k];
      if (publisher != ros::this_node::getName()) return publisher;
    }
  }
  return std::string();
}

}  // namespace

void takeBackSimTime() {
  // At an end, which comes also where the master has gone.
  if (otherPublisher(topics::kClock, Silence::kIsNoAnswer).empty()) ros::param::del(kSimTime);
}

ClockSource::ClockSource(ros::NodeHandle node, const ros::Time& time) : time_(time) {
  if (!ros::Time::isSimTime()) {
    throw std::invalid_argument(
        std::string("parameter ~publish_clock is true, but ") + kSimTime +
        " is not: set it before any node starts, or all of them go by the wall clock");
  }
  const std::string other = otherPublisher(topics::kClock, Silence::kIsWaitedFor);
  if (!other.empty())
    throw std::invalid_argument("parameter ~publish_clock is true, but " + other +
                                " publishes /clock already");
  publisher_ = node.advertise<rosgraph_msgs::Clock>(topics::kClock, 100);
  thread_ = std::thread([this] { repeat(); });
}

ClockSource::~ClockSource() {
  stop();
}

void ClockSource::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ends_ = true;
  }
  ended_.notify_all();
  if (!thread_.joinable()) return;
  thread_.join();
  takeBackSimTime();
}

void ClockSource::advanceTo(const ros::Time& time) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (time <= time_) return;
  time_ = time;
  publish();
}

void ClockSource::repeat() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!ends_) {
    publish();
    ended_.wait_for(lock, kPeriod);
  }
}

void ClockSource::publish() {
  rosgraph_msgs::Clock clock;
  clock.clock = time_;
  publisher_.publish(clock);
}

}  // namespace sunlit::ros_interface
