#include "sunlit/ros/node_main.h"

#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>

#include <exception>

namespace sunlit::ros_interface {

int runNode(int argc, char** argv, const std::string& name, const std::function<int()>& node) {
  ros::init(argc, argv, name);
  // roscpp and its console end with the last handle: without this one, an exception that destroys the node's
  // own handles on its way here could no longer be printed.
  const ros::NodeHandle alive;
  try {
    return node();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
}

}  // namespace sunlit::ros_interface
