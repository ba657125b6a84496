#include "ros/activity.h"

#include "sunlit/ros/topic_names.h"

namespace sunlit::ros_interface {

ActivityOutput::ActivityOutput(ros::NodeHandle private_node)
    : publisher_(private_node.advertise<Activity>(topics::kActivity, 10, true)) {}

void ActivityOutput::say(const std::string& doing, const std::string& detail, const ActivityShare& share) {
  constexpr std::chrono::seconds kPeriod(1);
  const bool changed = doing != latest_.doing || detail != latest_.detail;
  if (!changed && Clock::now() - said_ < kPeriod) return;
  said_ = Clock::now();
  latest_.doing = doing;
  latest_.detail = detail;
  latest_.share = share.share;
  latest_.seconds_left = share.seconds_left;
  publisher_.publish(latest_);
}

}  // namespace sunlit::ros_interface
