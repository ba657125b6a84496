// How an evaluation ends: with everything accounted for and all files written.
#include <chrono>
#include <filesystem>

#include "evaluate/run/evaluation_state.h"
#include "evaluate/run/run_file.h"
#include "sunlit/evaluate/comparisons/comparisons.h"
#include "sunlit/evaluate/localise/map.h"

namespace sunlit::evaluate {
namespace {

constexpr std::chrono::seconds kSummingAtMost{2};
constexpr std::chrono::milliseconds kAskedEach{100};  // whether a run is broken off

}  // namespace

Outcome Evaluation::State::finish(const StopToken& broken_off) {
  const bool is_at_once = broken_off.isStopped();  // which may ask for counts()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_finished_ = true;
    is_broken_off_ = is_at_once;
    for (std::size_t s = 0; s < options_.streams.size(); ++s)
      nameOtherSuns(s, suns_.finish(options_.streams[s]));
    for (const std::int64_t stamp : sets_.openStamps()) close(stamp, poses_.of(stamp), Reason::kEnd);
  }
  waitForWork(broken_off);
  queue_.rethrow();
  leaveOutUnplaced();
  Outcome outcome;
  outcome.is_broken_off = is_broken_off_;
  outcome.counts = counts();
  outcome.absent_poses = nameAbsentPoses();
  settleAndWrite(outcome);
  forgetEarlierResults();
  if (outcome.isWhole() && isVerifying() && isWholePath()) std::filesystem::remove(file(kLostFile));
  finished_ = outcome;
  return outcome;
}

// Of a run that is broken off only for what is being written, which is soon done.
void Evaluation::State::waitForWork(const StopToken& broken_off) {
  while (!is_broken_off_) {
    if (queue_.waitForAtMost(0, kAskedEach)) return;
    is_broken_off_ = broken_off.isStopped();
  }
  const std::lock_guard<std::shared_mutex> nobody_writes(writing_);
  giveUpWork();
}

void Evaluation::State::giveUpWork() {
  const std::lock_guard<std::mutex> lock(mutex_);
  while (!under_way_.empty()) {
    const std::shared_ptr<const Work> work = under_way_.begin()->second;
    giveUp(*work);
  }
}

std::size_t Evaluation::State::nameAbsentPoses() {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::size_t absent = 0;
  for (std::size_t k = 0; k < options_.poses.size(); ++k) {
    const std::int64_t pose = options_.poses.at(k);
    if (completed_.has(pose)) continue;
    ++absent;
    report({"absent", pose, std::nullopt, "", "no image of this pose came"});
  }
  return absent;
}

std::optional<std::int64_t> Evaluation::State::poseOf(const Problem& problem) const {
  if (problem.pose || !problem.stamp_ns) return problem.pose;
  return poses_.known(*problem.stamp_ns);
}

// By an image that came after all, as an earlier run was taken up. One that came too late, or cut short,
// beside one that an earlier run evaluated is none that was lacking.
bool Evaluation::State::isMended(const Problem& problem, const StampsOfPairs& evaluated) const {
  const std::optional<std::int64_t> pose = poseOf(problem);
  if (!pose || problem.kind == "duplicate") return false;
  if (problem.kind == "absent" && completed_.has(*pose)) return true;  // also where nothing of it is compared
  const bool is_left_out = problem.kind == kLeftOutBefore;
  const bool is_of_image = problem.kind == "undecodable" || problem.kind == "late";
  for (std::size_t p = 0; p < options_.pairs.size(); ++p) {
    if (evaluated.count({*pose, p}) == 0) continue;
    const PairSpec& pair = options_.pairs[p];
    const bool is_in_pair = problem.where == pair.a || problem.where == pair.b;
    const bool is_new = is_of_image && held_.count({*pose, p}) == 0;
    if (problem.kind == "absent" || problem.where == pair.name() || (is_in_pair && (is_left_out || is_new)))
      return true;
  }
  return false;
}

// How many pairs, or pictures, of expected poses earlier runs could not evaluate and this one was not asked
// to.
std::size_t Evaluation::State::countNotMended(const std::vector<Problem>& earlier) const {
  static const std::set<std::string> of_pair = {"missing_partner", "undecodable", "size_mismatch", "dropped",
                                                "failed",          "unplaced",    kLeftOutBefore};
  const auto isMeant = [&](const Problem& problem) {
    const std::optional<std::int64_t> pose = poseOf(problem);
    const bool is_stream = std::count(options_.streams.begin(), options_.streams.end(), problem.where) > 0;
    return of_pair.count(problem.kind) != 0 && (!is_stream || problem.kind == kLeftOutBefore) && pose &&
           options_.poses.holds(*pose);
  };
  return static_cast<std::size_t>(std::count_if(earlier.begin(), earlier.end(), isMeant));
}

void Evaluation::State::settleAndWrite(Outcome& outcome) {
  const std::lock_guard<std::mutex> lock(mutex_);
  StampsOfPairs evaluated;
  poses_.rank();
  settleRecords();
  for (const PairRecord& record : records_) evaluated[{record.pose, record.pair}] = record.stamp_ns;
  const auto settled = [this](std::int64_t stamp, std::int64_t pose) {
    return poses_.known(stamp).value_or(pose);
  };
  if (pictures_) pictures_->finish(settled);
  if (drawn_) drawn_->finish(settled);
  keepFinalDrawn();
  frames_file_.close();
  verified_file_.close();
  writeRecords();
  writeLostFeatures();
  outcome.summary = summarise(layout_, records_);
  writeSummary(file("summary.csv"), outcome.summary);
  if (isVerifying()) outcome.verified = writeVerifiedSummaries();
  const auto is_of_two = [this](std::int64_t stamp) { return !places_.fault(stamp).empty(); };
  const auto is_left_out = [this](const std::string& stream, const CaptureRecord& capture) {
    return isLeftOutCapture(stream, capture);
  };
  const LeftOutPlaces left_out = record_files_->finish(options_.streams, is_left_out, is_of_two);
  for (const auto& [count, what] :
       {std::pair{left_out.without_image, "stamps without an image"},
        {left_out.unplaced, "stamps of which no capture says which pose they are"},
        {left_out.of_two, "stamps of two places"}}) {
    if (count > 0 && callbacks_.note)
      callbacks_.note(file("path.csv") + ": " + std::to_string(count) + " poses of " + what + " left out");
  }
  if (poses_.strayCaptures() > 0 && callbacks_.note)
    callbacks_.note(
        file("captures.csv") + ": " + std::to_string(poses_.strayCaptures()) +
        " stamps, none of them that of an image: poses are numbered by the order of their images");
  outcome.not_mended = countNotMended(
      problems_->finish(poses_, [&](const Problem& problem) { return isMended(problem, evaluated); }));
  writeRunFile(file("run.yaml"), options_, &outcome, nullptr);
}

// Of a run that is broken off, with hundreds of pairs, intervals may take longer than the patience of whoever
// broke it off.
std::vector<VerifiedSummaryRow> Evaluation::State::writeVerifiedSummaries() const {
  const std::string path = file("verified_summary.csv");
  const auto latest = std::chrono::steady_clock::now() + kSummingAtMost;
  const StopToken stop([&] { return is_broken_off_ && std::chrono::steady_clock::now() > latest; });
  try {
    const std::vector<VerifiedSummaryRow> rows = summariseVerified(verified_layout_, verified_, stop);
    writeVerifiedSummary(path, rows);
    return rows;
  } catch (const Stopped&) {
    std::filesystem::remove(path);  // of an earlier end, and of fewer poses
    if (callbacks_.note)
      callbacks_.note(path +
                      ": left out, since its intervals take longer than a run that is broken off has; "
                      "the same run again writes it");
    return {};
  }
}

// What is made of frames.csv after the end: of an earlier one, and of fewer poses, nobody should find it
// where this run is stopped before it makes its own.
void Evaluation::State::forgetEarlierResults() {
  std::filesystem::remove(file("comparisons.csv"));
  if (observer_ && canLocalise()) forgetLocalised();
}

void Evaluation::State::compareMethods(const StopToken& stop) {
  const std::string path = file("comparisons.csv");
  std::filesystem::remove(path);
  std::vector<Measured> measured;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    measured = measuredOf(layout_, records_, options_.comparer.known.namesOfDetectors());
    for (Measured& one : measuredOf(verified_layout_, verified_)) measured.push_back(std::move(one));
  }
  measured.insert(measured.end(), localised_.begin(), localised_.end());
  std::vector<std::string> references = mapStreamsOf(options_.localisation);
  references.push_back(nameOfMap(references));  // in which queries are localised, of several streams, too
  const Comparisons compared = comparisonsOf(measured, references, stop);
  writeComparisons(path, compared.rows);
  for (const std::string& line : compared.left_out) {
    if (callbacks_.note) callbacks_.note(line);
  }
}

}  // namespace sunlit::evaluate
