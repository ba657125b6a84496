/// evaluate_bags: the evaluator on recorded bags, without a master. See README.md.
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "ros/evaluator/bag_evaluation.h"

namespace {

using namespace sunlit::ros_interface;

const char* const kUsage =
    "usage: evaluate_bags [--config FILE.yaml] [--namespace NAME] [--merge DIR]... --out DIR [BAG...]\n"
    "  Evaluates images recorded under NAME/<stream>/camera/image_raw as evaluator_node would.\n"
    "  --config     parameters as in config/evaluator.yaml; without: its defaults, and all streams that the "
    "bags hold\n"
    "  --out        folder for the results (output_dir); an unfinished run in it is taken up again\n"
    "  --namespace  of the topics; default /\n"
    "  --merge      takes over the values of a run of other poses with the same parameters, made on another "
    "machine, say\n"
    "exit status: 0 all evaluated, 3 some pairs could not be, 1 error\n";

ParameterReader defaultsFor(const BagEvaluationOptions& options) {
  const std::vector<std::string> streams = streamsIn(options.bags, options.name_space);
  if (streams.empty())
    throw std::runtime_error("the bags hold no " + options.name_space + "<stream>/camera/image_raw");
  XmlRpc::XmlRpcValue tree;
  for (std::size_t i = 0; i < streams.size(); ++i) tree["streams"][static_cast<int>(i)] = streams[i];
  tree["output_dir"] = "by --out";
  return ParameterReader(tree, "defaults");
}

BagEvaluationOptions optionsOf(int argc, char** argv) {
  BagEvaluationOptions options;
  std::string config;
  std::string output;
  std::string merged;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word.rfind("--", 0) != 0) {
      options.bags.push_back(word);
      continue;
    }
    std::string* target = nullptr;
    if (word == "--config") target = &config;
    if (word == "--out") target = &output;
    if (word == "--merge") target = &merged;
    if (word == "--namespace") target = &options.name_space;
    if (target == nullptr) throw std::invalid_argument("unknown option " + word + "\n" + kUsage);
    if (++i == argc) throw std::invalid_argument(word + " needs a value\n" + kUsage);
    *target = argv[i];
    if (word == "--merge") options.evaluation.merge.push_back(merged);
  }
  if (options.bags.empty() && (options.evaluation.merge.empty() || config.empty())) {
    throw std::invalid_argument(std::string("no bag given\n") + kUsage);
  }
  if (output.empty()) throw std::invalid_argument(std::string("--out is missing\n") + kUsage);
  const std::vector<std::string> folders = options.evaluation.merge;
  const ParameterReader parameters = config.empty() ? defaultsFor(options) : parametersOfFile(config);
  options.evaluation = readEvaluatorOptions(parameters).evaluation;
  options.evaluation.output_dir = output;
  options.evaluation.merge = folders;
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::string(argv[1]) == "--help") {
    std::fputs(kUsage, stdout);
    return 0;
  }
  try {
    return evaluateBags(optionsOf(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "evaluate_bags: %s\n", error.what());
    return 1;
  }
}
