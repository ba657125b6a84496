#include "sunlit/ros/node_main.h"

#include <ros/console.h>
#include <ros/init.h>

#include <exception>

namespace sunlit::ros_interface {

int runNode(int argc, char** argv, const std::string& name, const std::function<int()>& node) {
  try {
    ros::init(argc, argv, name);
    return node();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
}

}  // namespace sunlit::ros_interface
