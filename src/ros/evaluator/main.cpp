/// evaluator_node: see README.md and config/evaluator.yaml.
#include "ros/evaluator/evaluator_node.h"
#include "sunlit/ros/node_main.h"

int main(int argc, char** argv) {
  using namespace sunlit::ros_interface;
  return runNode(argc, argv, "evaluator", [] {
    const ros::NodeHandle private_node("~");
    EvaluatorOptions options = readEvaluatorOptions(ParameterReader(private_node));
    options.evaluation.output_dir = wholeName(options.evaluation.output_dir);
    return EvaluatorNode(ros::NodeHandle(), private_node, options).run();
  });
}
