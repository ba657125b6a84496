#include "sunlit/ros/node_main.h"

#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>

#include <exception>

namespace sunlit::ros_interface {

int runNode(int argc, char** argv, const std::string& name, const std::function<int()>& node) {
  ros::init(argc, argv, name);
  // ROS and its log end with the last handle, which would be before the fatal line is written.
  const ros::NodeHandle keeps_ros_alive;
  try {
    return node();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
}

}  // namespace sunlit::ros_interface
