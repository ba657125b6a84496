/// sun_position_node: see README.md and config/sun_position.yaml.
#include <ros/init.h>

#include <memory>
#include <optional>
#include <vector>

#include "ros/sun_position/options.h"
#include "ros/sun_position/sun_position_node.h"
#include "sunlit/ros/node_main.h"

int main(int argc, char** argv) {
  using namespace sunlit::ros_interface;
  // Outlives an exception: the last handle to go shuts ROS down, and its console before the fatal line is
  // out.
  std::optional<ros::NodeHandle> ros_stays_up;
  return runNode(argc, argv, "sun_position", [&] {
    ros_stays_up.emplace();
    std::vector<std::unique_ptr<SunPositionNode>> suns;
    for (const NamedSun& sun : readSuns(ParameterReader(ros::NodeHandle("~")))) {
      suns.push_back(
          std::make_unique<SunPositionNode>(sun.condition.node(), sun.condition.privateNode(), sun.options));
    }
    ros::spin();
    return 0;
  });
}
