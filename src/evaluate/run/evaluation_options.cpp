#include "sunlit/evaluate/run/evaluation_options.h"

#include <algorithm>

#include "evaluate/files/files.h"

namespace sunlit::evaluate {
namespace {

const Range kCounts{0, 1e9};

std::string textOfPairs(const std::vector<PairSpec>& pairs) {
  std::string text;
  for (const PairSpec& pair : pairs) {
    const std::string every = pair.every == 1 ? "" : ", every: " + std::to_string(pair.every);
    text += (text.empty() ? "{a: " : ", {a: ") + pair.a + ", b: " + pair.b + every + "}";
  }
  return "[" + text + "]";
}

Choices verifiedOf(EvaluationOptions& options) {
  EvaluationOptions* const all = &options;
  return {options.comparer.known.namesOfDetectors(), [all] { return verifiedDetectors(*all); },
          [all](const std::vector<std::string>& some) { all->verify = some; }, true};
}

/// With the rows of the comparer where a reader looks for them.
std::vector<Field> rowsWith(const std::vector<Field>& of_comparer, const std::vector<Field>& of_localisation,
                            EvaluationOptions& options) {
  return joined(
      {{{"streams", &options.streams, "", {}, "names: NAME/camera/image_raw; required"},
        {"pairs",
         OwnForm{textOfPairs(options.pairs)},
         "",
         {},
         "a list of [a, b] or {a: name, b: name, every: 10}; [] for all. every needs captures or a "
         "frame_rate"}},
       of_comparer,
       {{"verify",
         verifiedOf(options),
         "",
         {},
         "detectors among the differences whose matches are checked against the truth; without this "
         "key sift and orb, where they are among them"}},
       of_localisation,
       {{"frame_rate",
         &options.frame_rate,
         "Hz",
         {0, 1e6},
         "a stamp is of pose round((stamp - stamp_start) * frame_rate); 0: of that of its capture, "
         "or else of its place in the order"},
        {"stamp_start",
         OwnForm{formatStamp(options.stamp_start_ns)},
         "s",
         {0, 4294967295.0},
         "seconds such as \"1719792000.000000000\", as text so that no digit is lost"}}});
}

}  // namespace

std::vector<std::string> verifiedDetectors(const EvaluationOptions& options) {
  return options.verify ? *options.verify : usualDetectors(options.comparer);
}

const PairSpec* thinnedPair(const EvaluationOptions& options) {
  const auto found = std::find_if(options.pairs.begin(), options.pairs.end(),
                                  [](const PairSpec& pair) { return pair.every > 1; });
  return found == options.pairs.end() ? nullptr : &*found;
}

bool isInPair(const EvaluationOptions& options, const std::string& stream) {
  return options.pairs.empty() ||
         std::any_of(options.pairs.begin(), options.pairs.end(),
                     [&](const PairSpec& pair) { return pair.a == stream || pair.b == stream; });
}

std::vector<std::string> queriesOf(const EvaluationOptions& options) {
  if (!options.localisation.queries.empty()) return options.localisation.queries;
  const std::vector<std::string> map = mapStreamsOf(options.localisation);
  std::vector<std::string> others;
  for (const std::string& stream : options.streams) {
    if (std::count(map.begin(), map.end(), stream) == 0 && isInPair(options, stream))
      others.push_back(stream);
  }
  return others;
}

std::vector<Field> decidingFieldsOf(EvaluationOptions& options) {
  const std::vector<Field> of_localisation = fieldsOf(options.localisation, options.comparer);
  return rowsWith(decidingFieldsOf(options.comparer),
                  options.localisation.map.empty() ? std::vector<Field>() : of_localisation, options);
}

std::vector<Field> fieldsOf(EvaluationOptions& options) {
  return joined(
      {rowsWith(fieldsOf(options.comparer), fieldsOf(options.localisation, options.comparer), options),
       {{"output_dir",
         &options.output_dir,
         "",
         {},
         "folder for the results; an unfinished run in it is taken up again; required"},
        {"poses", &options.poses.count, "", kCounts, "indices of poses to expect; 0: unknown"},
        {"first_pose", &options.poses.first, "", kCounts, "the first of them"},
        {"pose_stride", &options.poses.stride, "", {1, 1e9}, "only every n-th of them"},
        {"whole_path",
         &options.is_whole_path,
         "",
         {},
         "these are all poses that there are: what merging with others needs is removed at the end"},
        {"images",
         choiceOf(&options.images, {"none", "samples", "all"}),
         "",
         {},
         "to keep as PNG; samples: of five poses"},
        {"about", OwnForm{"{}"}, "", {}, "a map from names to values, copied into run.yaml"}}});
}

}  // namespace sunlit::evaluate
