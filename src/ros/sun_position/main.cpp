/// sun_position_node: see README.md and config/sun_position.yaml.
#include <ros/init.h>

#include <memory>
#include <vector>

#include "ros/sun_position/options.h"
#include "ros/sun_position/sun_position_node.h"
#include "sunlit/ros/node_main.h"

int main(int argc, char** argv) {
  using namespace sunlit::ros_interface;
  return runNode(argc, argv, "sun_position", [] {
    std::vector<std::unique_ptr<SunPositionNode>> suns;
    for (const NamedSun& sun : readSuns(ParameterReader(ros::NodeHandle("~")))) {
      suns.push_back(
          std::make_unique<SunPositionNode>(sun.condition.node(), sun.condition.privateNode(), sun.options));
    }
    ros::spin();
    return 0;
  });
}
