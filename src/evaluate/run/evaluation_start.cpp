// How an evaluation begins: with its options checked and what earlier runs left taken up.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <stdexcept>

#include "evaluate/run/evaluation_state.h"
#include "evaluate/run/run_file.h"
#include "evaluate/run/suns_of_runs.h"
#include "sunlit/evaluate/files/stream_name.h"
#include "sunlit/evaluate/same_place.h"
#include "sunlit/image/files.h"

namespace sunlit::evaluate {
namespace {

// Two poses at a time: while one waits for its slowest detector, the other keeps the processors busy.
constexpr int kPosesAtOnce = 2;
constexpr int kSamples = 5;  // rows of the paper's Fig. 1

std::size_t streamNamed(const std::string& key, const std::vector<std::string>& streams,
                        const std::string& name) {
  const auto found = std::find(streams.begin(), streams.end(), name);
  if (found == streams.end()) refuse(key, '"' + name + '"', "one of " + textOf(streams));
  return static_cast<std::size_t>(found - streams.begin());
}

void requireStreams(const std::vector<std::string>& streams) {
  for (const std::string& name : streams) requireStreamName(name, "a name in streams");
  for (const std::string& name : streams) {
    if (std::count(streams.begin(), streams.end(), name) > 1)
      refuse("streams", textOf(streams), "a list without " + name + " twice");
  }
}

void requirePairs(const std::vector<PairSpec>& pairs) {
  for (const PairSpec& pair : pairs) {
    require("every of the pair " + pair.name(), pair.every, Range::atLeast(1));
    const auto isSame = [&](const PairSpec& other) { return other.a == pair.a && other.b == pair.b; };
    if (std::count_if(pairs.begin(), pairs.end(), isSame) > 1)
      refuse("pairs", "a list", "one without " + pair.name() + " twice");
  }
}

/// `asked` under `key` are detectors, and compared.
void requireDetectors(const std::string& key, const std::vector<std::string>& asked,
                      const EvaluationOptions& options) {
  std::vector<std::string> known = options.comparer.known.namesOfDetectors();
  const std::vector<std::string>& compared = options.comparer.differences;
  known.erase(std::remove_if(known.begin(), known.end(),
                             [&](const std::string& name) {
                               return std::count(compared.begin(), compared.end(), name) == 0;
                             }),
              known.end());
  const std::string allowed =
      known.empty() ? "[], since none of the differences has a detector"
                    : "a list of some of " + textOf(known) + ", the detectors among the differences";
  for (const std::string& name : asked) {
    if (std::count(known.begin(), known.end(), name) == 0) refuse(key, textOf(asked), allowed);
  }
}

/// `streams` under `key` of localisation.
void requireInPairs(const std::string& key, const std::string& value, const std::vector<std::string>& streams,
                    const EvaluationOptions& options) {
  for (const std::string& stream : streams) {
    if (!isInPair(options, stream))
      refuse(key, value,
             "of streams that are in pairs, and " + stream + " is in none: add one of it to pairs");
  }
}

void requireLocalisation(const EvaluationOptions& options) {
  const LocalisationOfRun& asked = options.localisation;
  if (asked.map.empty()) return;
  const auto times = [](const std::vector<std::string>& list, const std::string& name) {
    return std::count(list.begin(), list.end(), name);
  };
  const std::vector<std::string> map = mapStreamsOf(asked);
  for (const std::string& stream : map) {
    streamNamed("localisation/map", options.streams, stream);
    if (times(map, stream) > 1)
      refuse("localisation/map", "\"" + asked.map + "\"", "streams joined by +, none of them twice");
  }
  for (const std::string& query : asked.queries) {
    streamNamed("localisation/queries", options.streams, query);
    if (times(map, query) > 0 || times(asked.queries, query) > 1)
      refuse("localisation/queries", textOf(asked.queries), "a list without the map, and of nothing twice");
  }
  requireInPairs("localisation/map", "\"" + asked.map + "\"", map, options);
  requireInPairs("localisation/queries", textOf(asked.queries), asked.queries, options);
  if (queriesOf(options).empty())
    refuse("localisation/map", "\"" + asked.map + "\"",
           "some of the streams in pairs, so that one is left to be looked for");
  const std::vector<std::string> detectors = localisingDetectors(asked, options.comparer);
  requireDetectors("localisation/detectors", detectors, options);
  if (detectors.empty())
    refuse("localisation/detectors", textOf(detectors), "at least one, or localisation/map empty");
}

EvaluationOptions completed(EvaluationOptions options) {
  requireFields(options);
  requireStreams(options.streams);
  if (options.pairs.empty()) options.pairs = allPairs(options.streams);
  if (options.pairs.empty())
    refuse("streams", textOf(options.streams), "a list of at least two, to make pairs of");
  if (options.output_dir.empty()) refuse("output_dir", "\"\"", "a folder");
  requirePairs(options.pairs);
  requireDetectors("verify", verifiedDetectors(options), options);
  requireLocalisation(options);
  require("memory_limit", static_cast<double>(options.memory_limit_bytes), Range::atLeast(1), "byte");
  return options;
}

FramesLayout layoutOf(const EvaluationOptions& options, const std::vector<std::string>& names) {
  FramesLayout layout;
  for (const PairSpec& pair : options.pairs) layout.pairs.emplace_back(pair.a, pair.b);
  layout.differences = names;
  return layout;
}

/// Leaves out of `frames`, which `folder` holds, what problems.csv there names: a run that was killed had no
/// time to take these rows out. Returns how many lines they had.
std::size_t leaveOutNamed(const std::string& folder, const std::vector<PairSpec>& pairs,
                          std::vector<PairRecord>& frames) {
  const auto of_two_places = problemsOf(kTwoPlaces, folder), of_other_suns = problemsOf(kOtherSun, folder);
  std::size_t dropped_lines = 0;
  const auto is_left_out = [&](const PairRecord& record) {
    const PairSpec& pair = pairs[record.pair];
    const bool has_other_sun = of_other_suns.count({record.stamp_ns, pair.a}) != 0 ||
                               of_other_suns.count({record.stamp_ns, pair.b}) != 0;
    if (!has_other_sun && of_two_places.count({record.stamp_ns, pair.name()}) == 0) return false;
    dropped_lines += record.values.size();
    return true;
  };
  frames.erase(std::remove_if(frames.begin(), frames.end(), is_left_out), frames.end());
  return dropped_lines;
}

/// Of pictures in `records`, which earlier runs evaluated: what is needed of their suns.
void takeUpSuns(const std::vector<PairSpec>& pairs, const std::vector<PairRecord>& records,
                const RecordFiles& files,
                const std::function<void(const std::string&, const Captures&)>& use) {
  std::set<std::pair<std::string, std::int64_t>> evaluated;  // streams and stamps
  for (const PairRecord& record : records) {
    const PairSpec& pair = pairs[record.pair];
    evaluated.insert({{pair.a, record.stamp_ns}, {pair.b, record.stamp_ns}});
  }
  std::map<std::string, Captures> by_stream;
  for (const auto& [key, capture] : files.captures()) {
    if (evaluated.count({key.first, capture.stamp_ns}) != 0) by_stream[key.first].push_back(capture);
  }
  for (const auto& [stream, captures] : by_stream) use(stream, captures);
}

/// Nothing but the expected poses is on a whole path: with others its summary would be of more poses than it
/// tells, and pictures that were kept of those would go.
void requireNothingBeside(const EvaluationOptions& options, const std::vector<PairRecord>& records) {
  if (!options.is_whole_path || options.poses.size() == 0) return;
  std::set<std::int64_t> evaluated, beside;
  for (const PairRecord& record : records) {
    evaluated.insert(record.pose);
    if (!options.poses.holds(record.pose)) beside.insert(record.pose);
  }
  if (beside.empty()) return;
  throw std::invalid_argument(
      "output_dir " + options.output_dir + (options.merge.empty() ? "" : ", with what is merged,") +
      " holds " + std::to_string(evaluated.size()) + " evaluated poses, and " +
      std::to_string(beside.size()) + " of them are not among the " + std::to_string(options.poses.size()) +
      " of this path: choose another output_dir, or as many poses as before");
}

}  // namespace

Evaluation::State::State(const EvaluationOptions& options, EvaluationCallbacks callbacks)
    : options_(completed(options)),
      callbacks_(std::move(callbacks)),
      comparer_(options_.comparer),
      layout_(layoutOf(options_, options_.comparer.differences)),
      verified_layout_(layoutOf(options_, verifiedDetectors(options_))),
      poses_(options_.frame_rate, options_.stamp_start_ns, options_.poses, !thinnedPair(options_)),
      sets_(options_.streams.size()),
      grey_(options_, pair_streams_),
      completed_(options_.poses),
      queue_(kPosesAtOnce) {
  for (const PairSpec& pair : options_.pairs) {
    const std::string key = "a name in pairs";
    pair_streams_.emplace_back(streamNamed(key, options_.streams, pair.a),
                               streamNamed(key, options_.streams, pair.b));
  }
  counts_.streams.resize(options_.streams.size());
  counts_.pairs.resize(options_.pairs.size());
  if (options_.poses.size() > 0) {
    const double last = static_cast<double>(options_.poses.size() - 1);
    for (int i = 0; i < kSamples; ++i)
      sampled_.insert(options_.poses.at(static_cast<std::size_t>(std::llround(last * i / (kSamples - 1)))));
  }
  image::makeFolder(options_.output_dir);
  claimFolder(options_.output_dir, settingsOf(options_));
  image::removeUnfinished(options_.output_dir);
  takeUpEarlierRuns();
  // Only now: what it names as left out is in no other file any more.
  problems_ = std::make_unique<ProblemFile>(options_.output_dir, options_.merge);
  prepareLocalisation();
  if (options_.images == KeptImages::kNone) return;
  pictures_ = std::make_unique<PictureWriter>(file("images"));
  if (isVerifying()) drawn_ = std::make_unique<PictureWriter>(file("matches"));
}

// Reads what a run left in `folder`.
LeftLines Evaluation::State::takeUp(const std::string& folder) {
  LoadedFrames loaded = loadFrames(folder + "/frames.csv", layout_);
  LeftLines left{loaded.dropped_lines, leaveOutNamed(folder, options_.pairs, loaded.records)};
  left.torn += takeUpVerified(folder, loaded.records);
  if (folder != options_.output_dir) record_files_->merge(folder, poses_);
  for (PairRecord& record : loaded.records) {
    poses_.remember(record.stamp_ns, record.pose);
    records_.push_back(std::move(record));
  }
  // Images that were not evaluated have their place among the others, too.
  for (const auto& [stamp, pose] : posesOfProblems(folder)) poses_.remember(stamp, pose);
  noteLeftOutBefore(folder);
  return left;
}

// Once the stamps and captures of all folders are known.
void Evaluation::State::settleTakenUp() {
  poses_.settleRemembered();
  settleRecords();
  for (const PairRecord& record : records_) {
    held_.emplace(std::make_pair(record.pose, record.pair), record.stamp_ns);
    ++counts_.pairs[record.pair].resumed;
  }
  // Without a rate a clock that begins anew with each run may have other times at the same poses, but for one
  // that stands still.
  takeUpSuns(options_.pairs, records_, *record_files_, [&](const std::string& stream, const Captures& seen) {
    if (!poses_.hasRate() && !standsStill(seen)) return;
    for (const CaptureRecord& capture : seen) suns_.takeUp(stream, capture);
  });
}

void Evaluation::State::requireMergeable(const std::string& folder) const {
  std::vector<std::string> needed = {"run.yaml", "frames.csv"};
  if (isVerifying()) needed.emplace_back("verified.csv");
  for (const std::string& name : needed) {
    if (!std::filesystem::exists(folder + "/" + name))
      throw std::invalid_argument("merge: " + folder + " holds no run that can be merged (no " + name + ")");
  }
  if (!holdsSettings(folder + "/run.yaml"))
    throw std::invalid_argument("merge: " + folder +
                                "/run.yaml tells no settings, so that it may be of others");
  requireSameSettings(folder + "/run.yaml", settingsOf(options_));
  if (hasForgottenObservations(folder))
    throw std::invalid_argument(
        "merge: " + folder +
        " keeps no observations.bin, so that its poses cannot be localised with others: "
        "merge the runs that it was merged of, or evaluate them in another folder without "
        "whole_path");
  if (isVerifying() && callbacks_.note && !holdsLost(folder + "/" + kLostFile))
    callbacks_.note("merge: " + folder +
                    " keeps no single features any more: lost_features.csv is without them");
}

// What single features and pictures a whole run saw it keeps in sums alone, to which those of further poses
// cannot be added.
void Evaluation::State::requireNothingForgotten() const {
  const std::size_t wanted = options_.poses.size(), whole = completed_.expected();
  if (!has_forgotten_ || wanted <= whole) return;
  throw std::invalid_argument(
      "output_dir " + options_.output_dir + " holds a run of " + std::to_string(whole) +
      " poses that has ended, of whose features sums alone were kept, so that it cannot "
      "grow to " +
      std::to_string(wanted) + ": choose another output_dir, or poses: " + std::to_string(whole));
}

// Whether earlier runs evaluated every pair that is wanted of it.
bool Evaluation::State::isHeldWhole(std::int64_t pose) const {
  for (std::size_t p = 0; p < options_.pairs.size(); ++p) {
    if (isWanted(p, pose) && held_.count({pose, p}) == 0) return false;
  }
  return true;
}

// Of a pose of which no pair is wanted there is no record. Earlier runs came past those before the last pose
// that they evaluated, and whoever goes on from what was evaluated begins at the first pose after it that
// lacks something; where nothing was evaluated, it begins with the first of all.
void Evaluation::State::takeUpPoses() {
  for (const PairRecord& record : records_) {
    if (isHeldWhole(record.pose)) completed_.takeUp(record.pose);
  }
  const auto last = std::max_element(records_.begin(), records_.end(),
                                     [](const auto& a, const auto& b) { return a.pose < b.pose; });
  if (last == records_.end()) return;
  for (std::size_t k = 0; k < options_.poses.size(); ++k) {
    const std::int64_t pose = options_.poses.at(k);
    if (isHeldWhole(pose)) {
      completed_.takeUp(pose);
    } else if (pose > last->pose) {
      return;
    }
  }
}

void Evaluation::State::takeUpEarlierRuns() {
  requireOneSun(options_);
  record_files_ = std::make_unique<RecordFiles>(options_.output_dir, poses_);
  mendLostFile(file(kLostFile));
  LeftLines left = takeUp(options_.output_dir);
  has_forgotten_ =
      hasForgottenFeatures() || (!records_.empty() && hasForgottenObservations(options_.output_dir));
  for (const std::string& folder : options_.merge) {
    requireMergeable(folder);
    left += takeUp(folder);
  }
  settleTakenUp();
  rankAll();
  takeUpPoses();
  requireNothingForgotten();
  requireNothingBeside(options_, records_);
  writeRunFile(file("run.yaml"), options_, nullptr, nullptr);  // not before: what is refused changes nothing
  if (left.torn + left.asked_again > 0 || !options_.merge.empty()) writeRecords();
  frames_file_.open(file("frames.csv"), framesHeader());
  if (isVerifying()) {
    verified_file_.open(file("verified.csv"), verifiedHeader());
    lost_file_.open(file(kLostFile), lostFileHeader());
  }
  tellTakenUp(left);
}

void Evaluation::State::tellTakenUp(const LeftLines& left) const {
  if (!callbacks_.note || (records_.empty() && left.torn + left.asked_again == 0)) return;
  std::string line = options_.output_dir + " holds " + std::to_string(records_.size()) +
                     " evaluated pairs of " + std::to_string(completed_.size()) +
                     " whole poses: not evaluated again";
  if (left.torn > 0) line += "; " + std::to_string(left.torn) + " lines of a torn end were left out";
  if (left.asked_again > 0)
    line += "; " + std::to_string(left.asked_again) +
            " lines of pictures that problems.csv leaves out, which are asked for again";
  callbacks_.note(line);
}

}  // namespace sunlit::evaluate
