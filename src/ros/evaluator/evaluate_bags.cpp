/// evaluate_bags: the evaluator on recorded bags, without a master. See README.md.
#include <cstdio>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "ros/evaluator/bag_evaluation.h"
#include "ros/tools/arguments.h"

namespace {

using namespace sunlit::ros_interface;
namespace tools = sunlit::tools;

constexpr const char* kHelp =
    R"(evaluate_bags: evaluates images recorded under NAME/<stream>/camera/image_raw as evaluator_node would. Needs no ROS master.

usage: evaluate_bags --out DIR [options] [BAG...]

  --out DIR                      folder for the results (output_dir); an unfinished run in it is taken up again
  --config FILE.yaml             parameters as in config/evaluator.yaml; without: its defaults, and all streams that the
                                 bags hold
  --namespace NAME               of the topics (default /)
  --merge DIR                    takes over the values of a run of other poses with the same parameters, made on another
                                 machine, say; may be repeated

exit status: 0 all evaluated, 3 some pairs could not be, 1 error
)";

ParameterReader defaultsFor(const BagEvaluationOptions& options) {
  const std::vector<std::string> streams = streamsIn(options.bags, options.name_space);
  if (streams.empty())
    throw std::runtime_error("the bags hold no " + options.name_space + "<stream>/camera/image_raw");
  XmlRpc::XmlRpcValue tree;
  for (std::size_t i = 0; i < streams.size(); ++i) tree["streams"][static_cast<int>(i)] = streams[i];
  tree["output_dir"] = "by --out";
  return ParameterReader(tree, "defaults");
}

/// Empty if help was asked for.
std::optional<BagEvaluationOptions> optionsOf(const std::vector<std::string>& arguments) {
  BagEvaluationOptions options;
  std::string config;
  std::string output;
  std::string merged;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& word = arguments[i];
    if (word == "--help" || word == "-h") return std::nullopt;
    if (word.rfind("--", 0) != 0) {
      options.bags.push_back(word);
      continue;
    }
    std::string* target = nullptr;
    if (word == "--config") target = &config;
    if (word == "--out") target = &output;
    if (word == "--merge") target = &merged;
    if (word == "--namespace") target = &options.name_space;
    if (target == nullptr) tools::rejectUnknown(word);
    if (i + 1 == arguments.size() || arguments[i + 1].empty()) tools::rejectMissingValue(word);
    *target = arguments[++i];
    if (word == "--merge") options.evaluation.merge.push_back(merged);
  }
  if (options.bags.empty() && (options.evaluation.merge.empty() || config.empty()))
    throw std::invalid_argument("no bag given, nor --merge with --config; --help lists all options");
  if (output.empty()) throw std::invalid_argument("--out DIR is missing; --help lists all options");
  const std::vector<std::string> folders = options.evaluation.merge;
  const ParameterReader parameters = config.empty() ? defaultsFor(options) : parametersOfFile(config);
  options.evaluation = readEvaluatorOptions(parameters).evaluation;
  options.evaluation.output_dir = output;
  options.evaluation.merge = folders;
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto options = optionsOf(std::vector<std::string>(argv + 1, argv + argc));
    if (options) return evaluateBags(*options);
    std::fputs(kHelp, stdout);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "evaluate_bags: %s\n", error.what());
    return 1;
  }
}
