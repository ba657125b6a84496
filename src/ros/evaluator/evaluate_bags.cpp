/// evaluate_bags: the evaluator on recorded bags, without a master. See README.md.
#include <algorithm>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "ros/evaluator/bag_evaluation.h"
#include "ros/evaluator/bag_localisation.h"
#include "ros/evaluator/bag_odometry.h"
#include "ros/evaluator/bag_topics.h"
#include "sunlit/studio/command_line.h"

namespace {

using namespace sunlit;
using namespace sunlit::ros_interface;

/// The parameters that a node needs, as the command line and what is recorded tell them.
XmlRpc::XmlRpcValue usualParameters(const std::vector<std::string>& streams) {
  XmlRpc::XmlRpcValue tree;
  for (std::size_t i = 0; i < streams.size(); ++i) tree["streams"][static_cast<int>(i)] = streams[i];
  tree["output_dir"] = "by --out";
  return tree;
}

std::vector<std::string> streamsOf(const BagEvaluationOptions& options) {
  const std::vector<std::string> streams = streamsIn(options.bags, options.name_space);
  if (!streams.empty()) return streams;
  const std::string root = rootOf(options.name_space);
  throw std::runtime_error(
      "the bags hold neither " + root + "<stream>/camera/image_raw nor that with /compressed; they hold: " +
      topicsInWords(topicsIn(options.bags)) +
      "; say what stands before <stream> by --namespace, or record a bag anew under such names: rosbag play "
      "BAG TOPIC:=" +
      root + "STREAM/camera/image_raw while rosbag record -a runs");
}

/// What is typed: bags to be evaluated, or a map and queries to be localised in it.
struct Options {
  BagEvaluationOptions evaluation;
  BagLocalisationOptions localisation;
  std::string config;                    ///< file; empty: none
  XmlRpc::XmlRpcValue parameters;        ///< of that file, which may be a pipe and is read once
  std::optional<EvaluatorOptions> read;  ///< the same
  double features_cache_gb = evaluate::kUsualFeaturesCache_gb;
};

/// Of what is localised; throws as optionsOf().
void completeLocalisation(Options* options) {
  BagLocalisationOptions& localisation = options->localisation;
  const std::vector<std::string>& words = options->evaluation.bags;
  const bool follows = !localisation.odometry.empty();
  if (follows && !(localisation.maps.empty() && localisation.queries.empty()))
    throw std::invalid_argument("--odometry goes without --map and --query");
  std::vector<std::string>& bags = follows ? localisation.odometry : localisation.queries;
  bags.insert(bags.end(), words.begin(), words.end());
  if (!follows && (localisation.maps.empty() || localisation.queries.empty()))
    throw std::invalid_argument("--map and --query need each other; --help lists all options");
  if (!options->evaluation.evaluation.merge.empty())
    throw std::invalid_argument("--merge is for differences alone");
  localisation.output_dir = options->evaluation.evaluation.output_dir;
  ViewTopics& topics = localisation.topics;
  topics.name_space = options->evaluation.name_space;
  for (std::string* topic : {&topics.images, &topics.camera_info, &topics.depth, &topics.poses})
    *topic = withSlash(*topic);
  if (options->read) localisation.intake = options->read->intake;
}

/// Of the file; and those that a node needs, where it lacks them.
ParameterReader parametersIn(const Options& options, const std::vector<std::string>& streams) {
  XmlRpc::XmlRpcValue tree = options.parameters;
  for (const auto& [key, value] : usualParameters(streams)) {
    if (!tree.hasMember(key)) tree[key] = value;
  }
  return {tree, options.config};
}

/// Of the file, if there is one, or the defaults; without streams there, all that the bags hold.
EvaluatorOptions parametersFor(const Options& options) {
  const BagEvaluationOptions& evaluation = options.evaluation;
  if (options.config.empty())
    return readEvaluatorOptions(ParameterReader(usualParameters(streamsOf(evaluation)), "defaults"));
  const bool by_bags = !options.parameters.hasMember("streams") && !evaluation.bags.empty();
  return readEvaluatorOptions(
      parametersIn(options, by_bags ? streamsOf(evaluation) : std::vector<std::string>()));
}

/// Of what is evaluated.
void completeEvaluation(Options* options) {
  BagEvaluationOptions& evaluation = options->evaluation;
  if (evaluation.bags.empty() && (evaluation.evaluation.merge.empty() || options->config.empty()))
    throw std::invalid_argument("no bag given, nor --merge with --config; --help lists all options");
  const std::string output = evaluation.evaluation.output_dir;
  const std::vector<std::string> folders = evaluation.evaluation.merge;
  const EvaluatorOptions read = parametersFor(*options);
  evaluation.evaluation = read.evaluation;
  evaluation.intake = read.intake;
  evaluation.report = read.report;
  evaluation.evaluation.output_dir = output;
  evaluation.evaluation.merge = folders;
}

/// "--map-every" of the row "map_every".
std::string optionOf(std::string key) {
  std::replace(key.begin(), key.end(), '_', '-');
  return "--" + key;
}

/// Throws std::invalid_argument for what only localisation and odometry heed.
void refuseLocalisation(const studio::CommandLine& line, Options* options) {
  for (const std::vector<Field>& rows :
       {fieldsOf(options->localisation.localisation), fieldsOf(options->localisation.topics)}) {
    for (const Field& row : rows) line.requireWith(optionOf(row.key), {"--map", "--odometry"});
  }
}

/// Before the others: which detectors they may name stands in the file.
void readConfig(const std::vector<std::string>& arguments, Options* options) {
  const std::string option = "--config";
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == option && i + 1 < arguments.size()) options->config = arguments[i + 1];
    if (arguments[i].rfind(option + "=", 0) == 0) options->config = arguments[i].substr(option.size() + 1);
  }
  if (options->config.empty()) return;
  // Which streams there are is not asked here.
  options->parameters = readParameterFile(options->config);
  options->read = readEvaluatorOptions(parametersIn(*options, {"any"}));
  options->localisation.localisation.known = options->read->evaluation.comparer.known;
  options->features_cache_gb = options->read->features_cache_gb;
}

/// Empty if help was asked for.
std::optional<Options> optionsOf(const std::vector<std::string>& arguments) {
  Options options;
  readConfig(arguments, &options);
  const std::vector<Field> rows = fieldsOf(options.evaluation);
  studio::CommandLine line(
      "evaluate_bags: evaluates recorded images as evaluator_node would, or localises them in a map made of "
      "others. Needs no ROS master.",
      "evaluate_bags --out DIR (BAG... | --map BAG --query BAG... | --odometry BAG...) [options]\n\n"
      "exit status: 0 all evaluated, 3 some pairs or images could not be, 1 error");
  line.takeWords(&options.evaluation.bags);
  line.add("--out DIR", fieldOf(rows, "output_dir"));
  line.add("--config FILE.yaml",
           {"config",
            &options.config,
            "",
            {},
            "parameters of evaluator_node: config/evaluator.yaml is an example, and list_parameters prints "
            "all; without it their defaults, and without streams in it all that the bags hold; localisation "
            "takes those of detectors from it"});
  line.add("--namespace NAME", fieldOf(rows, "namespace"));
  line.add("--merge DIR", fieldOf(rows, "merge"));
  line.add("--features-cache-limit GB", evaluate::featuresCacheRow(&options.features_cache_gb));
  line.group("Localisation: where each image of one bag is, by a map made of those of another");
  const std::vector<Field> bags = fieldsOf(options.localisation);
  line.add("--map BAG[:STREAM,...]", fieldOf(bags, "map"));
  line.add("--query BAG[:STREAM,...]", fieldOf(bags, "query"));
  line.add("--odometry BAG[:STREAM,...]", fieldOf(bags, "odometry"));
  for (const Field& row : fieldsOf(options.localisation.localisation))
    line.add(optionOf(row.key) + " VALUE", row);
  line.group("Localisation and odometry of bags that sunlit did not record");
  for (const Field& row : fieldsOf(options.localisation.topics)) {
    const bool is_topic = std::holds_alternative<std::string*>(row.place);
    line.add(optionOf(row.key) + (is_topic ? " TOPIC" : " VALUE"), row);
  }
  if (!line.read(arguments)) return std::nullopt;
  if (!line.has("--out")) throw std::invalid_argument("--out DIR is missing; --help lists all options");
  const bool localises = line.has("--map") || line.has("--query") || line.has("--odometry");
  if (!localises) refuseLocalisation(line, &options);
  localises ? completeLocalisation(&options) : completeEvaluation(&options);
  return options;
}

int run(Options options) {
  const auto cache = evaluate::FeatureCache::usual(options.features_cache_gb, [](const std::string& line) {
    std::fprintf(stderr, "evaluate_bags: %s\n", line.c_str());
  });
  options.localisation.localisation.cache = options.evaluation.evaluation.comparer.cache = cache;
  if (!options.localisation.odometry.empty()) return odometryOfBags(options.localisation);
  if (!options.localisation.maps.empty()) return localiseBags(options.localisation);
  return evaluateBags(options.evaluation);
}

}  // namespace

int main(int argc, char** argv) {
  return studio::runProgram({"evaluate_bags", argc, argv}, optionsOf, run);
}
