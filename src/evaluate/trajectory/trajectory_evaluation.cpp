#include "sunlit/evaluate/trajectory/trajectory_evaluation.h"

#include <cmath>
#include <map>
#include <stdexcept>

#include "evaluate/files/files.h"
#include "sunlit/image/files.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::evaluate {
namespace {

constexpr double kTooLoose_rad = 0.2;

MatchedPoses matchedBy(const Association& association, const Trajectory& truth, const Trajectory& estimate) {
  MatchedPoses matched;
  for (const Association::Pair& pair : association.pairs) {
    matched.truth.push_back(truth[pair.truth]);
    matched.estimate.push_back(estimate[pair.estimate]);
  }
  return matched;
}

void addRows(const std::string& metric, const PoseErrors& errors, std::vector<TrajectoryRow>* rows) {
  rows->push_back({metric, "m", statisticsOfErrors(errors.translation_m)});
  rows->push_back({metric + "_deg", "deg", statisticsOfErrors(errors.rotation_deg)});
}

}  // namespace

TrajectoryEvaluation evaluateTrajectory(const Trajectory& truth, const Trajectory& estimate,
                                        const TrajectoryOptions& options) {
  requireFields(options);
  if (truth.empty() || estimate.empty()) throw std::invalid_argument("a trajectory without poses");
  TrajectoryEvaluation result;
  result.association = associate(truth, estimate, std::llround(options.max_difference_s * 1e9));
  if (result.association.pairs.empty()) {
    throw std::invalid_argument("no pose of the estimate has one of the truth within " +
                                textOf(options.max_difference_s) + " s: the nearest are " +
                                textOf(leastDifference(truth, estimate)) + " s apart");
  }
  result.matched = matchedBy(result.association, truth, estimate);
  result.truth_from_estimate = truthFromEstimate(options.align, result.matched);
  result.matched.estimate = aligned(result.truth_from_estimate, std::move(result.matched.estimate));
  result.absolute = absoluteErrors(result.matched);
  addRows("ate", result.absolute, &result.rows);
  for (const Delta& delta : options.deltas)
    addRows("rpe_" + delta.name(), relativeErrors(result.matched, delta, options.pairs_from), &result.rows);
  return result;
}

std::string doubtOfAlignment(const TrajectoryEvaluation& evaluation) {
  const double loose_rad = evaluation.truth_from_estimate.loose_rad;
  if (!(loose_rad > kTooLoose_rad)) return "";
  return "positions hardly decide how the alignment turns the estimate, as along a line: their errors could "
         "turn it by " +
         (loose_rad < kPi ? std::to_string(std::lround(loose_rad / kRadPerDeg)) + " deg"
                          : std::string("any angle")) +
         ", and ate_deg may tell of that alone; to align by yaw, or not at all, leaves less open";
}

void writeTrajectoryTable(const std::string& path, const TrajectoryEvaluation& evaluation) {
  std::string text = "metric,unit,n,unmatched,rmse,mean,median,std,min,max,sse\n";
  for (const TrajectoryRow& row : evaluation.rows) {
    const ErrorStatistics& s = row.statistics;
    text += row.metric + "," + row.unit + "," + std::to_string(s.n) + "," +
            std::to_string(evaluation.association.estimate_left.size());
    for (const double value : {s.rmse, s.mean, s.median, s.std, s.min, s.max, s.sse})
      text += "," + formatNumber(value);
    text += "\n";
  }
  image::writeFileAtomically(path, text);
}

void writePoseErrors(const std::string& path, const Trajectory& truth, const Trajectory& estimate,
                     const TrajectoryEvaluation& evaluation) {
  std::multimap<std::int64_t, std::string> lines;
  const auto startOf = [&](const StampedPose& pose, const std::string& partner) {
    const Eigen::Vector3d place = evaluation.truth_from_estimate * pose.position;
    return formatStamp(pose.stamp_ns) + "," + partner + "," + formatNumber(place.x()) + "," +
           formatNumber(place.y()) + "," + formatNumber(place.z());
  };
  const Association& association = evaluation.association;
  for (std::size_t k = 0; k < association.pairs.size(); ++k) {
    const StampedPose& pose = estimate[association.pairs[k].estimate];
    lines.emplace(pose.stamp_ns, startOf(pose, formatStamp(truth[association.pairs[k].truth].stamp_ns)) +
                                     "," + formatNumber(evaluation.absolute.translation_m[k]) + "," +
                                     formatNumber(evaluation.absolute.rotation_deg[k]));
  }
  for (const std::size_t i : association.estimate_left)
    lines.emplace(estimate[i].stamp_ns, startOf(estimate[i], "") + ",,");
  for (const std::size_t i : association.truth_left)
    lines.emplace(truth[i].stamp_ns, "," + formatStamp(truth[i].stamp_ns) + ",,,,,");
  std::string text = "stamp,truth_stamp,x,y,z,ate,ate_deg\n";
  for (const auto& [stamp_ns, line] : lines) text += line + "\n";
  image::writeFileAtomically(path, text);
}

}  // namespace sunlit::evaluate
