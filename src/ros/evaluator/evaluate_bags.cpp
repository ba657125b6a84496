/// evaluate_bags: the evaluator on recorded bags, without a master. See README.md.
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "ros/evaluator/bag_evaluation.h"
#include "sunlit/studio/command_line.h"

namespace {

using namespace sunlit;
using namespace sunlit::ros_interface;

ParameterReader defaultsFor(const BagEvaluationOptions& options) {
  const std::vector<std::string> streams = streamsIn(options.bags, options.name_space);
  if (streams.empty())
    throw std::runtime_error("the bags hold no " + options.name_space +
                             "<stream>/camera/image_raw, nor that with /compressed");
  XmlRpc::XmlRpcValue tree;
  for (std::size_t i = 0; i < streams.size(); ++i) tree["streams"][static_cast<int>(i)] = streams[i];
  tree["output_dir"] = "by --out";
  return ParameterReader(tree, "defaults");
}

/// Empty if help was asked for.
std::optional<BagEvaluationOptions> optionsOf(const std::vector<std::string>& arguments) {
  BagEvaluationOptions options;
  std::string config;
  const std::vector<Field> rows = fieldsOf(options);
  studio::CommandLine line(
      "evaluate_bags: evaluates recorded images as evaluator_node would. Needs no ROS master.",
      "evaluate_bags --out DIR BAG... [options]\n\n"
      "exit status: 0 all evaluated, 3 some pairs could not be, 1 error");
  line.takeWords(&options.bags);
  line.add("--out DIR", fieldOf(rows, "output_dir"));
  line.add("--config FILE.yaml",
           {"config",
            &config,
            "",
            {},
            "parameters of evaluator_node: config/evaluator.yaml is an example, and list_parameters prints "
            "all; without it their defaults, and all streams that the bags hold"});
  line.add("--namespace NAME", fieldOf(rows, "namespace"));
  line.add("--merge DIR", fieldOf(rows, "merge"));
  if (!line.read(arguments)) return std::nullopt;
  if (!line.has("--out")) throw std::invalid_argument("--out DIR is missing; --help lists all options");
  if (options.bags.empty() && (options.evaluation.merge.empty() || config.empty()))
    throw std::invalid_argument("no bag given, nor --merge with --config; --help lists all options");
  const std::string output = options.evaluation.output_dir;
  const std::vector<std::string> folders = options.evaluation.merge;
  const ParameterReader parameters = config.empty() ? defaultsFor(options) : parametersOfFile(config);
  const EvaluatorOptions read = readEvaluatorOptions(parameters);
  options.evaluation = read.evaluation;
  options.intake = read.intake;
  options.evaluation.output_dir = output;
  options.evaluation.merge = folders;
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  return studio::runProgram({"evaluate_bags", argc, argv}, optionsOf, evaluateBags);
}
