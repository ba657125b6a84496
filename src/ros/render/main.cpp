#include <ros/console.h>
#include <tbb/global_control.h>

#include <exception>
#include <optional>
#include <string>

#include "ros/render/clock_source.h"
#include "ros/render/input_log.h"
#include "ros/render/render_node.h"
#include "sunlit/quantity/memory.h"
#include "sunlit/ros/node_main.h"

namespace {

using namespace sunlit::ros_interface;

int run(const ros::NodeHandle& private_node) {
  const ros::NodeHandle node;
  const ParameterReader parameters(private_node);
  const RenderNodeOptions options = readRenderNodeOptions(parameters);
  if (!options.warns_of_inputs) leaveInputsToAnother();
  const RenderConditions conditions = readRenderConditions(parameters, options.sky);
  parameters.rejectUnknown();
  std::optional<tbb::global_control> limit;
  if (options.threads > 0)
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));
  try {
    return RenderNode(node, private_node, options, conditions).run();
  } catch (const Interrupted&) {
    return 0;  // as between two pictures
  } catch (const NothingLeft& reason) {
    ROS_INFO("World and path are those of the run in this folder: %s", reason.what());
    return 0;
  }
}

bool isMeantToBeTheTime(const ros::NodeHandle& private_node) {
  bool publishes_clock = false;
  return private_node.getParam("publish_clock", publishes_clock) && publishes_clock;
}

int runOrTakeBackSimTime() {
  const ros::NodeHandle private_node("~");
  try {
    return run(private_node);
  } catch (const std::exception& error) {
    if (isMeantToBeTheTime(private_node)) takeBackSimTime();
    if (areInputsLeftToAnother()) {
      ROS_INFO("It ends: %s", sunlit::reasonInWords(error).c_str());
      if (doesAnotherEndAll()) return 1;
    }
    throw;
  }
}

}  // namespace

int main(int argc, char** argv) {
  return runNode(argc, argv, "render", runOrTakeBackSimTime);
}
