/// evaluate_bags: the evaluator on recorded bags, without a master. See README.md.
#include <boost/program_options.hpp>
#include <cstdio>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ros/evaluator/bag_evaluation.h"

namespace {

using namespace sunlit::ros_interface;
namespace po = boost::program_options;

constexpr const char* kHelp =
    R"(evaluate_bags: evaluates images recorded under NAME/<stream>/camera/image_raw (or …/compressed) as evaluator_node would. Needs no ROS master.

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
    throw std::runtime_error("the bags hold no " + options.name_space +
                             "<stream>/camera/image_raw, nor that with /compressed");
  XmlRpc::XmlRpcValue tree;
  for (std::size_t i = 0; i < streams.size(); ++i) tree["streams"][static_cast<int>(i)] = streams[i];
  tree["output_dir"] = "by --out";
  return ParameterReader(tree, "defaults");
}

po::options_description knownOptions() {
  po::options_description known;
  const auto text = [] { return po::value<std::string>(); };
  known.add_options()("help,h", "")("out", text())("config", text())("namespace", text())("merge", text())(
      "bag", text());
  return known;
}

/// The words of a command line in their order: an option's name, or "bag", and a value. Throws
/// std::invalid_argument naming an option that there is not, or that lacks its value.
std::vector<std::pair<std::string, std::string>> wordsOf(const std::vector<std::string>& arguments) {
  const po::options_description known = knownOptions();
  po::positional_options_description bags;
  bags.add("bag", -1);
  std::vector<std::pair<std::string, std::string>> words;
  try {
    const int exact = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
    for (const po::option& option :
         po::command_line_parser(arguments).options(known).positional(bags).style(exact).run().options) {
      words.emplace_back(option.string_key, option.value.empty() ? std::string() : option.value[0]);
      if (words.back().second.empty() && option.string_key != "help")
        throw std::invalid_argument("--" + option.string_key + " needs a value; --help lists all options");
    }
  } catch (const po::error& error) {
    throw std::invalid_argument(std::string(error.what()) + "; --help lists all options");
  }
  return words;
}

/// Empty if help was asked for.
std::optional<BagEvaluationOptions> optionsOf(const std::vector<std::string>& arguments) {
  BagEvaluationOptions options;
  std::string config;
  std::string output;
  for (const auto& [key, value] : wordsOf(arguments)) {
    if (key == "help") return std::nullopt;
    if (key == "bag") options.bags.push_back(value);
    if (key == "config") config = value;
    if (key == "out") output = value;
    if (key == "merge") options.evaluation.merge.push_back(value);
    if (key == "namespace") options.name_space = value;
  }
  if (options.bags.empty() && (options.evaluation.merge.empty() || config.empty()))
    throw std::invalid_argument("no bag given, nor --merge with --config; --help lists all options");
  if (output.empty()) throw std::invalid_argument("--out DIR is missing; --help lists all options");
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
