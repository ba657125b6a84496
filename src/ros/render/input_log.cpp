#include "ros/render/input_log.h"

#include <ros/init.h>
#include <ros/time.h>

namespace sunlit::ros_interface {

namespace {

// Of the whole process, as the log itself is.
ros::console::Level level = ros::console::levels::Warn;

}  // namespace

ros::console::Level inputLevel() {
  return level;
}

void leaveInputsToAnother() {
  level = ros::console::levels::Info;
}

bool areInputsLeftToAnother() {
  return level != ros::console::levels::Warn;
}

bool doesAnotherEndAll() {
  // Both load the same world at once, one a little later than the other, and an experiment gives the end of
  // one 5 s until it breaks off.
  const ros::WallDuration patience(15.0), period(0.05);
  const ros::WallTime begin = ros::WallTime::now();
  while (!ros::isShuttingDown() && ros::WallTime::now() - begin < patience) period.sleep();
  return ros::isShuttingDown();
}

}  // namespace sunlit::ros_interface
