// What a run keeps to localise by, and how it is localised at its end.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <stdexcept>

#include "evaluate/run/evaluation_state.h"
#include "evaluate/run/run_file.h"
#include "sunlit/evaluate/localise/map.h"

namespace sunlit::evaluate {
namespace {

constexpr const char* kObservations = "observations.bin";
constexpr const char* kRows = "localisation.csv";
constexpr const char* kPoses = "localisation_poses.csv";
constexpr const char* kSummary = "localisation_summary.csv";

LocalisationOptions optionsOf(const EvaluationOptions& options) {
  const LocalisationOfRun& asked = options.localisation;
  return {options.comparer.known, localisingDetectors(asked, options.comparer), asked.map_every_m,
          asked.localiser, options.comparer.cache};
}

ObservedStreams streamsOf(const EvaluationOptions& options) {
  return {mapStreamsOf(options.localisation), queriesOf(options)};
}

bool isAmong(const std::vector<std::string>& streams, const std::string& stream) {
  return std::count(streams.begin(), streams.end(), stream) > 0;
}

/// Of a stream whose pairs are all thinned: "every 10 of h04-h12"; empty where one is not.
std::string thinnedBy(const std::vector<PairSpec>& pairs, const std::string& stream) {
  std::string text;
  for (const PairSpec& pair : pairs) {
    if (pair.a != stream && pair.b != stream) continue;
    if (pair.every == 1) return "";
    text += (text.empty() ? "every " : ", every ") + std::to_string(pair.every) + " of " + pair.name();
  }
  return text;
}

/// What is not localised, or not at each pose, since pictures that are not compared have no features.
std::vector<std::string> notesOfPairs(const EvaluationOptions& options) {
  std::vector<std::string> notes;
  const ObservedStreams roles = streamsOf(options);
  for (const std::string& stream : options.streams) {
    const bool is_of_map = isAmong(roles.map, stream);
    if (!is_of_map && options.localisation.queries.empty() && !isInPair(options, stream))
      notes.push_back(stream + ": not looked for in the map, since it is in no pair");
    const std::string thinned = thinnedBy(options.pairs, stream);
    if (thinned.empty() || !(is_of_map || isAmong(roles.queries, stream))) continue;
    notes.push_back(stream + (is_of_map ? ": key frames" : ": looked for") +
                    " at the poses of its pairs alone: " + thinned);
  }
  return notes;
}

using Pictures = std::set<std::pair<std::string, std::int64_t>>;  // streams and stamps

Pictures evaluatedPictures(const EvaluationOptions& options, const std::vector<PairRecord>& records) {
  Pictures evaluated;
  for (const PairRecord& record : records) {
    evaluated.emplace(options.pairs[record.pair].a, record.stamp_ns);
    evaluated.emplace(options.pairs[record.pair].b, record.stamp_ns);
  }
  return evaluated;
}

/// Whether `rows` are of the pictures in `records`. Others may have localised some of the same names, in
/// another map, by other detectors or of other times.
bool areOf(const EvaluationOptions& options, const std::vector<PairRecord>& records,
           const std::vector<LocalisationRow>& rows) {
  const Pictures evaluated = evaluatedPictures(options, records);
  const std::string map = nameOfMap(mapStreamsOf(options.localisation));
  std::set<std::string> detectors;
  for (const LocalisationRow& row : rows) {
    if (row.map != map || evaluated.count({row.query, row.stamp_ns}) == 0) return false;
    detectors.insert(row.detector);
  }
  const std::vector<std::string> asked = localisingDetectors(options.localisation, options.comparer);
  return detectors == std::set<std::string>(asked.begin(), asked.end());
}

std::vector<std::unique_ptr<ObservationFile>> observationsOf(const std::vector<std::string>& folders) {
  std::vector<std::unique_ptr<ObservationFile>> files;
  for (const std::string& folder : folders) {
    const std::string path = folder + "/" + kObservations;
    if (!std::filesystem::exists(path))
      throw std::runtime_error(path + ": is not there, so its poses cannot be localised with the others");
    files.push_back(std::make_unique<ObservationFile>(path));
  }
  return files;
}

StreamPoses lookedFor(const std::vector<LocalisationRow>& rows) {
  StreamPoses pictures;
  for (const LocalisationRow& row : rows) pictures.emplace(row.query, static_cast<std::int64_t>(row.pose));
  return pictures;
}

// Also where the pair of a picture failed, as where one of several detectors throws.
std::set<std::string> localisedStreams(const std::vector<LocalisationRow>& rows) {
  std::set<std::string> streams;
  for (const LocalisationRow& row : rows) streams.insert({row.map, row.query});
  return streams;
}

}  // namespace

void Evaluation::State::prepareLocalisation() {
  if (options_.localisation.map.empty()) return;
  observer_ = std::make_unique<Observer>(
      Observer::Setup{options_.streams, streamsOf(options_),
                      localisingDetectors(options_.localisation, options_.comparer), file(kObservations)});
  for (const std::string& line : notesOfPairs(options_)) {
    if (callbacks_.note) callbacks_.note(line);
  }
  const std::size_t torn = observer_->observations().torn();
  if (torn > 0 && callbacks_.note)
    callbacks_.note(file(kObservations) + ": " + std::to_string(torn) + " bytes of a torn end were left out");
}

// Under mutex_.
void Evaluation::State::addTruth(std::int64_t stamp_ns, const std::function<void(GroundTruth&)>& add) {
  if (is_finished_ || !observer_ || sets_.isTaken(stamp_ns)) return;
  add(observer_->truth());
  closeIfWhole(stamp_ns);
  keepWithinMemory(stamp_ns);
}

void Evaluation::State::addDepth(std::int64_t stamp_ns, const Told<cv::Mat>& depth) {
  const std::lock_guard<std::mutex> lock(mutex_);
  addTruth(stamp_ns, [&](GroundTruth& truth) { truth.addDepth(stamp_ns, depth); });
}

void Evaluation::State::addTruePose(std::int64_t stamp_ns, const Told<Eigen::Isometry3d>& map_from_optical) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_finished_) return;
  Told<Eigen::Isometry3d> pose = map_from_optical;
  const bool is_known = pose.has_come && pose.fault.empty();
  if (is_known && places_.isBroken(stamp_ns, pose.value)) separate(stamp_ns);
  if (const std::string fault = places_.fault(stamp_ns); !fault.empty())
    pose = unusable<Eigen::Isometry3d>(fault);
  addTruth(stamp_ns, [&](GroundTruth& truth) { truth.addPose(stamp_ns, pose); });
}

void Evaluation::State::addPoseProblem(std::int64_t stamp_ns, const std::string& kind,
                                       const std::string& reason) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!is_finished_) report({kind, std::nullopt, stamp_ns, "pose", reason});
}

void Evaluation::State::addCamera(std::size_t stream, std::int64_t stamp_ns, const Told<ViewCamera>& camera) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_finished_ || !observer_) return;
  observer_->truth().cameras(stream).add(stamp_ns, camera, !sets_.isTaken(stamp_ns));
  closeWhole(stamp_ns);
}

// Of stamps up to that one: the cameras of those before it will not come any more.
void Evaluation::State::closeWhole(std::int64_t last_ns) {
  for (const std::int64_t stamp : sets_.openStamps()) {
    if (stamp > last_ns) return;
    closeIfWhole(stamp);
  }
}

// Names the pictures that can be neither key frame nor query.
void Evaluation::State::observeSet(const StampSet& set, Work& work) {
  if (!observer_) return;
  work.truth = observer_->truth().take(set.stamp_ns);
  work.observed.assign(set.streams.size(), 0);
  const std::vector<char> needed = neededStreams(set.stamp_ns, work.pose);
  for (std::size_t s = 0; s < set.streams.size(); ++s) {
    const bool is_needed = needed[s] != 0 && !suns_.isOther(options_.streams[s], set.stamp_ns);
    if (set.streams[s].rgb.empty() || !is_needed) continue;
    const std::string fault = observer_->faultOf(s, work.truth, set.streams[s].rgb.size());
    work.observed[s] = fault.empty() ? 1 : 0;
    if (!fault.empty()) reportUnlocalised(work, s, fault);
  }
}

void Evaluation::State::reportUnlocalised(const Work& work, std::size_t stream, const std::string& fault) {
  ++counts_.streams[stream].unlocalised;
  report({"unlocalised", work.pose, work.stamp_ns, options_.streams[stream], fault});
}

bool Evaluation::State::isObserved(const Work& work, std::size_t stream, std::size_t difference) const {
  return observer_ && work.observed[stream] != 0 &&
         observer_->observes(stream, layout_.differences[difference]);
}

LocalisationOutcome Evaluation::State::localise(const LocaliseCallbacks& callbacks) {
  LocalisationOutcome outcome;
  if (!observer_) return outcome;
  if (const std::vector<LocalisationRow> rows = localisedBefore(); !rows.empty()) {
    localised_ = measuredOf(rows);
    // Not of the rows, which lack what its last columns are made of.
    if (std::filesystem::exists(file(kSummary))) outcome.summary = loadLocalisationSummary(file(kSummary));
    if (isWholePath()) std::filesystem::remove(file(kObservations));  // the empty one of this run
    return outcome;
  }
  if (canLocalise()) forgetLocalised();
  const Pictures evaluated = evaluatedPictures(options_, records_);
  // By this run, or by an earlier one, and not evaluated since, or before that.
  const auto isLeftOutPicture = [&](const ObservationKey& key) {
    const bool is_named =
        suns_.isOther(key.stream, key.stamp_ns) || left_out_before_.count({key.stream, key.stamp_ns}) != 0;
    return is_named && evaluated.count({key.stream, key.stamp_ns}) == 0;
  };
  const std::vector<std::unique_ptr<ObservationFile>> merged = observationsOf(options_.merge);
  const auto counting = [&](const ObservationKey& key) -> std::optional<std::int64_t> {
    if (!places_.fault(key.stamp_ns).empty() || isLeftOutPicture(key)) return std::nullopt;
    return poses_.settled(key.stamp_ns, key.pose);
  };
  ObservedDrives drives{{&observer_->observations()}, streamsOf(options_), counting};
  for (const auto& other : merged) drives.files.push_back(other.get());
  const LocalisationOptions options = optionsOf(options_);
  const ObservedResult result =
      localiseObserved(drives, options, {callbacks.progress, callbacks.found, callbacks.stop});
  outcome.is_asked = true;
  outcome.key_frames = result.key_frames;
  outcome.unplaced = result.unplaced;
  outcome.queries = result.rows.size();
  outcome.unobserved = evaluatedBut(lookedFor(result.rows), drives.streams.queries);
  outcome.unmapped = evaluatedBut(result.to_map, drives.streams.map);
  if (outcome.key_frames > 0 && outcome.unmapped > 0 && callbacks_.note)
    callbacks_.note("map: " + std::to_string(outcome.unmapped) +
                    " of its pictures were none to choose key frames from, for want of depth, pose or "
                    "camera_info: see problems.csv");
  outcome.uncompared = uncompared(drives.streams, localisedStreams(result.rows));
  writeRunFile(file("run.yaml"), options_, &finished_, &outcome);
  if (result.rows.empty()) return outcome;
  localised_ = measuredOf(result.rows);
  outcome.summary = summariesOf(result.rows);
  writeLocalisation(file(kRows), result.rows);
  writeLocalisationPoses(file(kPoses), result.rows);
  writeLocalisationSummary(file(kSummary), outcome.summary);
  // Of a run that is not whole the same run again evaluates the rest.
  if (outcome.isWhole() && finished_.isWhole() && isWholePath()) std::filesystem::remove(file(kObservations));
  return outcome;
}

// By a run that was whole, and has forgotten its observations; empty where this one has any, or others than
// these poses were localised.
std::vector<LocalisationRow> Evaluation::State::localisedBefore() const {
  if (canLocalise()) return {};
  if (!std::filesystem::exists(file(kRows))) return {};
  const std::vector<LocalisationRow> rows = loadLocalisation(file(kRows));
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!areOf(options_, records_, rows)) return {};
  }
  return evaluatedBut(lookedFor(rows), streamsOf(options_).queries) == 0 ? rows
                                                                         : std::vector<LocalisationRow>();
}

// There is what new results can be made of.
bool Evaluation::State::canLocalise() const {
  return !options_.merge.empty() || !observer_->observations().keys().empty();
}

void Evaluation::State::forgetLocalised() const {
  for (const char* name : {kRows, kPoses, kSummary}) std::filesystem::remove(file(name));
}

// It was localised, and what it observed is gone.
bool Evaluation::State::hasForgottenObservations(const std::string& folder) const {
  const std::string kept = folder + "/" + kObservations;
  const bool is_kept = std::filesystem::exists(kept) && std::filesystem::file_size(kept) > 0;
  return !options_.localisation.map.empty() && !is_kept && std::filesystem::exists(folder + "/" + kRows);
}

// All poses are here, and there are no others, so that no other run will ask for what was observed.
bool Evaluation::State::isWholePath() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return options_.is_whole_path && completed_.isWhole();
}

// Evaluated pictures of `streams` that are none of `some`.
std::size_t Evaluation::State::evaluatedBut(const StreamPoses& some,
                                            const std::vector<std::string>& streams) const {
  StreamPoses others;
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const PairRecord& record : records_) {
    for (const std::string& stream : {options_.pairs[record.pair].a, options_.pairs[record.pair].b}) {
      if (isAmong(streams, stream) && some.count({stream, record.pose}) == 0)
        others.emplace(stream, record.pose);
    }
  }
  return others.size();
}

// But for those that were `found`.
std::vector<std::string> Evaluation::State::uncompared(const ObservedStreams& streams,
                                                       std::set<std::string> found) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const PairRecord& record : records_)
    found.insert({options_.pairs[record.pair].a, options_.pairs[record.pair].b});
  std::vector<std::string> others;
  for (const auto* some : {&streams.map, &streams.queries}) {
    for (const std::string& stream : *some) {
      if (found.count(stream) == 0) others.push_back(stream);
    }
  }
  return others;
}

}  // namespace sunlit::evaluate
