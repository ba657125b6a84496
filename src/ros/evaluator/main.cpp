/// evaluator_node: see README.md and config/evaluator.yaml.
#include "ros/evaluator/evaluator_node.h"
#include "sunlit/ros/node_main.h"

int main(int argc, char** argv) {
  using namespace sunlit::ros_interface;
  return runNode(argc, argv, "evaluator", [] {
    const ros::NodeHandle private_node("~");
    EvaluatorNode evaluator(ros::NodeHandle(), private_node,
                            readEvaluatorOptions(ParameterReader(private_node)));
    return evaluator.run();
  });
}
