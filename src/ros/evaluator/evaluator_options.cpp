#include "ros/evaluator/evaluator_options.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ros/evaluator/detector_plugins.h"
#include "sunlit/evaluate/differences/feature_difference.h"
#include "sunlit/evaluate/features/detector_plugin.h"
#include "sunlit/ros/node_rows.h"

namespace sunlit::ros_interface {
namespace {

using XmlRpc::XmlRpcValue;

constexpr double kBytesPerGigabyte = 1e9;

/// Nothing where it is neither [a, b] nor {a: name, b: name, every: 10}.
std::optional<evaluate::PairSpec> pairOf(XmlRpcValue entry) {
  evaluate::PairSpec pair;
  const auto take = [](XmlRpcValue value, std::string* name) {
    if (value.getType() == XmlRpcValue::TypeString) *name = static_cast<std::string>(value);
    return !name->empty();
  };
  if (entry.getType() == XmlRpcValue::TypeArray && entry.size() == 2)
    return take(entry[0], &pair.a) && take(entry[1], &pair.b) ? std::optional(pair) : std::nullopt;
  if (entry.getType() != XmlRpcValue::TypeStruct) return std::nullopt;
  for (auto& member : entry) {
    const bool is_every = member.first == "every" && member.second.getType() == XmlRpcValue::TypeInt;
    if (is_every) {
      pair.every = static_cast<int>(member.second);
    } else if (!(member.first == "a" && take(member.second, &pair.a)) &&
               !(member.first == "b" && take(member.second, &pair.b))) {
      return std::nullopt;
    }
  }
  return pair.a.empty() || pair.b.empty() ? std::nullopt : std::optional(pair);
}

std::vector<evaluate::PairSpec> readPairs(const ParameterReader& parameters, const Field& row) {
  std::vector<evaluate::PairSpec> pairs;
  XmlRpcValue value = parameters.value(row.key);
  if (!value.valid()) return pairs;
  const bool is_list = value.getType() == XmlRpcValue::TypeArray;
  for (int i = 0; is_list && i < value.size(); ++i) {
    const auto pair = pairOf(value[i]);
    if (!pair) break;
    pairs.push_back(*pair);
  }
  if (!is_list || pairs.size() < static_cast<std::size_t>(value.size()))
    refuse("parameter " + parameters.fullName(row.key), plainText(value), row.allowed() + notAsText(value));
  return pairs;
}

/// Text keeps all nine digits, which a floating-point number of seconds since 1970 does not.
std::int64_t readStampStart(const ParameterReader& parameters, const Field& row) {
  constexpr double kNanosecondsPerSecond = 1e9;
  XmlRpcValue value = parameters.value(row.key);
  if (!value.valid() || value.getType() != XmlRpcValue::TypeString)
    return std::llround(parameters.number(row.key, 0.0, row.range) * kNanosecondsPerSecond);
  const std::string called = "parameter " + parameters.fullName(row.key);
  const std::string text = static_cast<std::string>(value);
  const std::size_t point = std::min(text.find('.'), text.size());
  std::string fraction = point < text.size() ? text.substr(point + 1) : "";
  const bool is_digits = text.find_first_not_of("0123456789.") == std::string::npos;
  if (!is_digits || point == 0 || point > 10 || fraction.size() > 9 ||
      fraction.find('.') != std::string::npos)
    refuse(called, '"' + text + '"', row.allowed());
  require(called, std::stod(text.substr(0, point)), row.range, row.unit);
  fraction.resize(9, '0');
  return std::stoll(text.substr(0, point) + fraction);
}

std::vector<std::pair<std::string, std::string>> readAbout(const ParameterReader& parameters,
                                                           const Field& row) {
  std::vector<std::pair<std::string, std::string>> about;
  XmlRpcValue value = parameters.value(row.key);
  if (!value.valid()) return about;
  if (value.getType() != XmlRpcValue::TypeStruct)
    refuse("parameter " + parameters.fullName(row.key), plainText(value), row.allowed() + notAsText(value));
  for (auto& member : value) about.emplace_back(member.first, plainText(member.second));
  return about;
}

std::vector<std::string> preprocessingWords() {
  std::vector<std::string> words = evaluate::preprocessingNames();
  words.insert(words.begin(), evaluate::kNoPreprocessing);
  return words;
}

/// One of those built in, or one that a package brings; empty where there is none.
std::string typeOf(const ParameterReader& parameters, const std::string& key) {
  const std::string type = parameters.text(key, "");
  if (!isPluginName(type)) return parameters.choice(key, "", evaluate::detectorTypes());
  const std::vector<std::string> all = pluginNames();
  if (std::count(all.begin(), all.end(), type) == 0)
    refuse("parameter " + parameters.fullName(key), '"' + type + '"',
           "one of " + textOf(evaluate::detectorTypes()) + ", or of " + textOf(all) +
               ", which packages on ROS_PACKAGE_PATH bring");
  return type;
}

/// Whether a detector of this name is in this build, or in others.
bool isBuiltIn(const std::string& name) {
  const std::vector<std::string>& types = evaluate::detectorTypes();
  const std::vector<evaluate::AbsentDetector>& absent = evaluate::absentDetectors();
  return std::count(types.begin(), types.end(), name) > 0 ||
         std::any_of(absent.begin(), absent.end(), [&](const auto& one) { return one.type == name; });
}

/// Detectors under names of their own: features/NAME/type says what they are, and features/NAME/preprocessing
/// what they look through.
void addDetectors(const ParameterReader& parameters, evaluate::Differences& known) {
  const std::vector<std::string>& types = evaluate::detectorTypes();
  for (const std::string& name : parameters.namesBelow("features")) {
    if (isBuiltIn(name)) continue;
    const std::string key = "features/" + name + "/type";
    const std::string type = typeOf(parameters, key);
    if (type.empty())
      refuse("parameter " + parameters.fullName(key), "missing",
             "one of " + textOf(types) + ", since no detector is called " + name);
    const std::string seen_through = parameters.choice("features/" + name + "/preprocessing",
                                                       evaluate::kNoPreprocessing, preprocessingWords());
    evaluate::DetectorKind kind{type, seen_through == evaluate::kNoPreprocessing ? "" : seen_through};
    auto of_type = isPluginName(type) ? loadDetector(type) : evaluate::makeDetector(type);
    known.add(name, evaluate::makeFeatureDifference(evaluate::makeOwnDetector(kind, std::move(of_type))));
  }
}

/// One file serves all builds: features/ of detectors that this one lacks are known, though without effect.
void takeAbsent(const ParameterReader& parameters) {
  for (const auto& [type, why] : evaluate::absentDetectors()) {
    parameters.value("features/" + type);
    XmlRpcValue names = parameters.value("differences");
    for (int i = 0; names.getType() == XmlRpcValue::TypeArray && i < names.size(); ++i) {
      if (plainText(names[i]) == type)
        refuse("parameter " + parameters.fullName("differences"), plainText(names),
               "without " + type + ", which this build does not have (" + why + ")");
    }
  }
}

}  // namespace

std::vector<Field> fieldsOf(EvaluatorOptions& options) {
  return joined({fieldsOf(options.evaluation),
                 fieldsOf(options.intake),
                 {diagnosticPeriodRow(&options.diagnostic_period_s)},
                 {{"memory_limit", &options.memory_limit_gb, "GB", {1e-3, 1e6}, "of images that wait"},
                  evaluate::featuresCacheRow(&options.features_cache_gb),
                  {"idle_timeout",
                   &options.idle_timeout_s,
                   "s",
                   {0, 1e6},
                   "without any image, after which what is missing is named and the rest written; 0: never"},
                  {"report",
                   &options.report,
                   "",
                   {},
                   "draw report.html once all is evaluated, as rosrun sunlit report does"},
                  {"exit_when_done",
                   &options.exit_when_done,
                   "",
                   {},
                   "end once all expected poses are accounted for"}}});
}

std::vector<Field> fieldsOfOwnDetector(evaluate::Preprocessings& preprocessings) {
  return under("features/NAME", joined({evaluate::ownDetectorFields({}), preprocessings.fields()}));
}

EvaluatorOptions readEvaluatorOptions(const ParameterReader& parameters) {
  EvaluatorOptions options;
  evaluate::EvaluationOptions& e = options.evaluation;
  addDetectors(parameters, e.comparer.known);
  const std::vector<Field> rows = fieldsOf(options);
  takeAbsent(parameters);
  parameters.read(rows);
  if (e.streams.empty())
    refuse("parameter " + parameters.fullName("streams"), "missing",
           "a list of names such as [h04, h12, h20]");
  if (e.output_dir.empty())
    refuse("parameter " + parameters.fullName("output_dir"), "missing", "a folder for the results");
  e.pairs = readPairs(parameters, fieldOf(rows, "pairs"));
  e.stamp_start_ns = readStampStart(parameters, fieldOf(rows, "stamp_start"));
  e.about = readAbout(parameters, fieldOf(rows, "about"));
  e.memory_limit_bytes = static_cast<std::size_t>(kBytesPerGigabyte * options.memory_limit_gb);
  parameters.value(options.intake.transport);  // of its plug-in, which may have left some here
  parameters.rejectUnknown();
  return options;
}

}  // namespace sunlit::ros_interface
