#include "ros/evaluator/bag_odometry.h"

#include <cstdio>
#include <set>
#include <utility>

#include "ros/evaluator/bag_streams.h"
#include "ros/evaluator/progress_log.h"
#include "ros/evaluator/result_files.h"
#include "ros/evaluator/view_source.h"
#include "sunlit/evaluate/localise/odometry_runs.h"
#include "sunlit/evaluate/run/run_folder.h"
#include "sunlit/evaluate/trajectory/trajectory_evaluation.h"

namespace sunlit::ros_interface {
namespace {

/// Root mean squares over 10 m; none where the drive is shorter.
evaluate::TrajectoryOptions comparison() {
  evaluate::TrajectoryOptions options;
  options.deltas = {{10.0, evaluate::Delta::Unit::kMetres}};
  options.pairs_from = evaluate::PathOf::kTruth;
  return options;
}

evaluate::OdometryRow rowOf(const evaluate::Trajectory& truth, const evaluate::Trajectory& estimate) {
  const evaluate::TrajectoryEvaluation evaluation = evaluateTrajectory(truth, estimate, comparison());
  evaluate::OdometryRow row;
  row.length_m = lengthOf(truth);
  row.end_error_m = evaluation.absolute.translation_m.back();
  for (const evaluate::TrajectoryRow& one : evaluation.rows) {
    if (one.metric == "rpe_10m") row.rpe_10m_m = one.statistics.rmse;
    if (one.metric == "rpe_10m_deg") row.rpe_10m_deg = one.statistics.rmse;
  }
  return row;
}

class BagOdometry {
 public:
  explicit BagOdometry(const BagLocalisationOptions& options)
      : options_(options), source_({options.topics, options.intake, options.output_dir, true}) {}

  void follow(const BagStream& stream) {
    const auto views = source_.open(stream);
    evaluate::OdometryRuns runs(options_.localisation);
    evaluate::Trajectory truth;
    std::vector<evaluate::Trajectory> estimates(options_.localisation.detectors.size());
    source_.forEach(*views, source_.usable(*views, true),
                    {"poses followed", true, [&](const auto& entries, const auto& read) {
                       const auto followed = runs.follow(read);
                       for (std::size_t i = 0; i < entries.size(); ++i) {
                         const BagViews::Entry& entry = views->entries()[entries[i]];
                         truth.push_back(poseOfLink(entry.stamp_ns, entry.map_from_optical));
                         for (std::size_t d = 0; d < estimates.size(); ++d)
                           estimates[d].push_back(poseOfLink(entry.stamp_ns, followed.poses[d][i]));
                       }
                       return followed.faults;
                     }});
    if (truth.empty()) {
      not_followed_.push_back(stream.name);
      return;
    }
    trajectories_.emplace_back(truthFile(stream), truth);
    for (std::size_t d = 0; d < estimates.size(); ++d) add(stream, d, {truth, estimates[d]}, runs);
  }

  int finish() const {
    if (rows_.empty()) source_.fail("no stream can be followed");
    const std::string file = options_.output_dir + "/" + kOdometryTable;
    writeOdometry(file, rows_);
    for (const auto& [name, trajectory] : trajectories_)
      writeTrajectory(options_.output_dir + "/" + name, trajectory);
    std::printf("\n%-8s %-9s %5s %5s %10s %9s %14s %16s %12s\n", "stream", "detector", "n", "lost",
                "key frames", "length m", "drift per 10 m", "turn per 10 m", "end error m");
    for (const evaluate::OdometryRow& row : rows_) {
      std::printf("%-8s %-9s %5zu %5zu %10zu %9.1f %11.3f m %12.3f deg %12.3f\n", row.stream.c_str(),
                  row.detector.c_str(), row.n, row.lost, row.key_frames, row.length_m, row.rpe_10m_m,
                  row.rpe_10m_deg, row.end_error_m);
    }
    std::printf("%s\n", file.c_str());
    for (const std::string& stream : not_followed_)
      std::fprintf(stderr, "%s: nothing to follow\n", stream.c_str());
    const int status = source_.finish();
    return not_followed_.empty() ? status : kNotWholeStatus;
  }

 private:
  void add(const BagStream& stream, std::size_t d, const evaluate::MatchedPoses& poses,
           const evaluate::OdometryRuns& runs) {
    evaluate::OdometryRow row = rowOf(poses.truth, poses.estimate);
    row.stream = stream.name;
    row.detector = options_.localisation.detectors[d];
    row.n = poses.estimate.size();
    row.lost = runs.at(d).lost();
    row.key_frames = runs.at(d).keyFrames();
    rows_.push_back(row);
    trajectories_.emplace_back(odometryFile(stream, row.detector), poses.estimate);
  }

  const BagLocalisationOptions& options_;
  ViewSource source_;
  std::vector<std::string> not_followed_;  // streams of which nothing can be used
  std::vector<evaluate::OdometryRow> rows_;
  std::vector<std::pair<std::string, evaluate::Trajectory>> trajectories_;  // of each file
};

std::set<std::string> resultsOf(const std::vector<BagStream>& streams,
                                const std::vector<std::string>& detectors) {
  std::set<std::string> names = {kOdometryTable};
  for (const BagStream& stream : streams) {
    names.insert(truthFile(stream));
    for (const std::string& detector : detectors) names.insert(odometryFile(stream, detector));
  }
  return names;
}

}  // namespace

int odometryOfBags(const BagLocalisationOptions& options) {
  const LocalisationStreams streams = localisationStreams({}, options.odometry, options.topics);
  BagOdometry odometry(options);
  evaluate::requireNoRun(options.output_dir);
  requireOnlyOwnResults(options.output_dir, resultsOf(streams.queries, options.localisation.detectors));
  for (const BagStream& stream : streams.queries) odometry.follow(stream);
  return odometry.finish();
}

}  // namespace sunlit::ros_interface
