#include "ros/evaluator/evaluator_options.h"

#include <cmath>
#include <stdexcept>

namespace sunlit::ros_interface {
namespace {

using XmlRpc::XmlRpcValue;

std::string textOf(XmlRpcValue value) {
  if (value.getType() == XmlRpcValue::TypeString) return static_cast<std::string>(value);
  return value.toXml();
}

// For run.yaml: as a person would type it.
std::string plainText(XmlRpcValue value) {
  switch (value.getType()) {
    case XmlRpcValue::TypeString:
      return static_cast<std::string>(value);
    case XmlRpcValue::TypeInt:
      return std::to_string(static_cast<int>(value));
    case XmlRpcValue::TypeBoolean:
      return static_cast<bool>(value) ? "true" : "false";
    case XmlRpcValue::TypeDouble: {
      char buffer[40];
      std::snprintf(buffer, sizeof buffer, "%.15g", static_cast<double>(value));
      return buffer;
    }
    case XmlRpcValue::TypeArray: {
      std::string text;
      for (int i = 0; i < value.size(); ++i) text += (i == 0 ? "" : ", ") + plainText(value[i]);
      return "[" + text + "]";
    }
    default:
      return textOf(value);
  }
}

evaluate::PairSpec pairOf(XmlRpcValue entry, const std::string& key) {
  const auto fail = [&] {
    throw std::invalid_argument("parameter " + key +
                                " must be a list of [a, b] or {a: name, b: name, every: 10}");
  };
  evaluate::PairSpec pair;
  if (entry.getType() == XmlRpcValue::TypeArray && entry.size() == 2) {
    if (entry[0].getType() != XmlRpcValue::TypeString || entry[1].getType() != XmlRpcValue::TypeString)
      fail();
    pair.a = static_cast<std::string>(entry[0]);
    pair.b = static_cast<std::string>(entry[1]);
    return pair;
  }
  if (entry.getType() != XmlRpcValue::TypeStruct) fail();
  for (auto& member : entry) {
    const bool is_text = member.second.getType() == XmlRpcValue::TypeString;
    if (member.first == "a" && is_text) {
      pair.a = static_cast<std::string>(member.second);
    } else if (member.first == "b" && is_text) {
      pair.b = static_cast<std::string>(member.second);
    } else if (member.first == "every" && member.second.getType() == XmlRpcValue::TypeInt) {
      pair.every = static_cast<int>(member.second);
    } else {
      fail();
    }
  }
  if (pair.a.empty() || pair.b.empty()) fail();
  return pair;
}

std::vector<evaluate::PairSpec> readPairs(const ParameterReader& parameters) {
  std::vector<evaluate::PairSpec> pairs;
  XmlRpcValue value = parameters.value("pairs");
  if (!value.valid()) return pairs;
  const std::string key = parameters.fullName("pairs");
  if (value.getType() != XmlRpcValue::TypeArray) {
    throw std::invalid_argument("parameter " + key + " must be a list of pairs; an empty list means all");
  }
  for (int i = 0; i < value.size(); ++i) pairs.push_back(pairOf(value[i], key));
  return pairs;
}

std::vector<evaluate::Difference> readDifferences(const ParameterReader& parameters) {
  std::vector<std::string> names;
  for (const evaluate::Difference difference : evaluate::allDifferences())
    names.push_back(nameOf(difference));
  std::vector<evaluate::Difference> differences;
  for (const std::string& name : parameters.texts("differences", names)) {
    try {
      differences.push_back(evaluate::differenceNamed(name));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("parameter " + parameters.fullName("differences") + ": " + error.what());
    }
  }
  return differences;
}

evaluate::FeatureOptions readFeatures(const ParameterReader& p) {
  evaluate::FeatureOptions f;
  f.sift.n_features = p.integer("features/sift/n_features", f.sift.n_features, {0, 1e6});
  f.sift.n_octave_layers = p.integer("features/sift/n_octave_layers", f.sift.n_octave_layers, {1, 10});
  f.sift.contrast_threshold = p.number("features/sift/contrast_threshold", f.sift.contrast_threshold, {0, 1});
  f.sift.edge_threshold = p.number("features/sift/edge_threshold", f.sift.edge_threshold, {1e-3, 1e6});
  f.sift.sigma = p.number("features/sift/sigma", f.sift.sigma, {0.1, 10});
#ifdef SUNLIT_SURF
  f.surf.hessian_threshold = p.number("features/surf/hessian_threshold", f.surf.hessian_threshold, {0, 1e6});
  f.surf.octaves = p.integer("features/surf/n_octaves", f.surf.octaves, {1, 8});
  f.surf.octave_layers = p.integer("features/surf/n_octave_layers", f.surf.octave_layers, {1, 16});
  f.surf.extended = p.flag("features/surf/extended", f.surf.extended);
  f.surf.upright = p.flag("features/surf/upright", f.surf.upright);
#else
  p.value("features/surf");  // known, though without effect in a build without SURF: one file serves both
#endif
  f.orb.n_features = p.integer("features/orb/n_features", f.orb.n_features, {1, 1e6});
  f.orb.scale_factor = p.number("features/orb/scale_factor", f.orb.scale_factor, {1.01, 4});
  f.orb.n_levels = p.integer("features/orb/n_levels", f.orb.n_levels, {1, 32});
  f.orb.edge_threshold = p.integer("features/orb/edge_threshold", f.orb.edge_threshold, {1, 200});
  f.orb.first_level = p.integer("features/orb/first_level", f.orb.first_level, {0, 31});
  f.orb.wta_k = p.integer("features/orb/wta_k", f.orb.wta_k, {2, 4});
  f.orb.patch_size = p.integer("features/orb/patch_size", f.orb.patch_size, {2, 200});
  f.orb.fast_threshold = p.integer("features/orb/fast_threshold", f.orb.fast_threshold, {1, 255});
  f.brisk.threshold = p.integer("features/brisk/threshold", f.brisk.threshold, {1, 255});
  f.brisk.n_octaves = p.integer("features/brisk/n_octaves", f.brisk.n_octaves, {0, 9});
  f.brisk.pattern_scale = p.number("features/brisk/pattern_scale", f.brisk.pattern_scale, {0.1, 10});
  return f;
}

// Text keeps all nine digits, which a floating-point number of seconds since 1970 does not.
std::int64_t readStampStart(const ParameterReader& parameters) {
  constexpr double kNanosecondsPerSecond = 1e9;
  XmlRpcValue value = parameters.value("stamp_start");
  if (!value.valid() || value.getType() != XmlRpcValue::TypeString) {
    return std::llround(parameters.number("stamp_start", 0.0, {0, 4294967296.0}) * kNanosecondsPerSecond);
  }
  const std::string text = static_cast<std::string>(value);
  const std::size_t point = std::min(text.find('.'), text.size());
  std::string fraction = point < text.size() ? text.substr(point + 1) : "";
  const bool is_digits = text.find_first_not_of("0123456789.") == std::string::npos;
  if (!is_digits || point == 0 || point > 10 || fraction.size() > 9 ||
      fraction.find('.') != std::string::npos) {
    throw std::invalid_argument("parameter " + parameters.fullName("stamp_start") + " is \"" + text +
                                "\", but must be seconds such as \"1719792000.000000000\"");
  }
  fraction.resize(9, '0');
  return std::stoll(text.substr(0, point) + fraction);
}

std::vector<std::pair<std::string, std::string>> readAbout(const ParameterReader& parameters) {
  std::vector<std::pair<std::string, std::string>> about;
  XmlRpcValue value = parameters.value("about");
  if (!value.valid()) return about;
  if (value.getType() != XmlRpcValue::TypeStruct) {
    throw std::invalid_argument("parameter " + parameters.fullName("about") +
                                " must be a map from names to values");
  }
  for (auto& member : value) about.emplace_back(member.first, plainText(member.second));
  return about;
}

}  // namespace

EvaluatorOptions readEvaluatorOptions(const ParameterReader& parameters) {
  EvaluatorOptions options;
  evaluate::EvaluationOptions& e = options.evaluation;
  e.streams = parameters.texts("streams", {});
  if (e.streams.empty()) {
    throw std::invalid_argument("parameter " + parameters.fullName("streams") +
                                " is missing: a list of names such as [h04, h12, h20]");
  }
  e.pairs = readPairs(parameters);
  e.comparer.differences = readDifferences(parameters);
  e.comparer.features = readFeatures(parameters);
  e.comparer.ratio_test.ratio = parameters.number("ratio", e.comparer.ratio_test.ratio, {1e-6, 1});
  e.comparer.ratio_test.inclusive = parameters.flag("inclusive", e.comparer.ratio_test.inclusive);
  e.output_dir = parameters.text("output_dir", "");
  if (e.output_dir.empty()) {
    throw std::invalid_argument("parameter " + parameters.fullName("output_dir") +
                                " is missing: a folder for the results");
  }
  e.poses = static_cast<std::size_t>(parameters.integer("poses", 0, {0, 1e9}));
  const std::string images = parameters.choice("images", "samples", {"none", "samples", "all"});
  e.images = images == "none"  ? evaluate::KeptImages::kNone
             : images == "all" ? evaluate::KeptImages::kAll
                               : evaluate::KeptImages::kSamples;
  e.frame_rate = parameters.number("frame_rate", 0.0, {0, 1e6});
  e.stamp_start_ns = readStampStart(parameters);
  e.max_waiting_images = static_cast<std::size_t>(parameters.integer("max_waiting_images", 3000, {2, 1e7}));
  e.about = readAbout(parameters);
  options.idle_timeout_s = parameters.number("idle_timeout", 0.0, {0, 1e6});
  options.exit_when_done = parameters.flag("exit_when_done", false);
  parameters.rejectUnknown();
  return options;
}

}  // namespace sunlit::ros_interface
