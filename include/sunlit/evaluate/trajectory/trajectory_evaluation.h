/// An estimated trajectory against the true one, and the files that tell of it.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sunlit/evaluate/trajectory/alignment.h"
#include "sunlit/evaluate/trajectory/association.h"
#include "sunlit/evaluate/trajectory/pose_errors.h"
#include "sunlit/quantity/field.h"

namespace sunlit::evaluate {

struct TrajectoryOptions {
  Alignment align = Alignment::kNone;
  double max_difference_s = 0.01;
  std::vector<Delta> deltas = {{1.0, Delta::Unit::kMetres},
                               {10.0, Delta::Unit::kMetres},
                               {1.0, Delta::Unit::kFrames}};  ///< of relative errors
  PathOf pairs_from = PathOf::kEstimate;
};

/// All but the deltas, which have a form of their own: parseDelta().
inline std::vector<Field> fieldsOf(TrajectoryOptions& options) {
  return {{"align",
           choiceOf(&options.align, {"none", "se3", "sim3", "yaw"}),
           "",
           {},
           "what of the estimate is undone before it is compared, by least squares: nothing; rotation and "
           "translation; scale too; rotation about z and translation"},
          {"max_difference",
           &options.max_difference_s,
           "s",
           {0, 1e6},
           "in time, between a pose of the estimate and the pose of the truth that it belongs to"},
          {"pairs_from",
           choiceOf(&options.pairs_from, {"estimate", "truth"}),
           "",
           {},
           "along whose path the metres of relative errors are counted; that of the truth gives every "
           "estimate the "
           "same pairs"}};
}

/// One line of the table.
struct TrajectoryRow {
  std::string metric;  ///< "ate", "rpe_10m", and of angles "ate_deg", "rpe_10m_deg"
  std::string unit;    ///< "m" or "deg"
  ErrorStatistics statistics;
};

struct TrajectoryEvaluation {
  Association association;
  Similarity truth_from_estimate;
  MatchedPoses matched;  ///< the estimate aligned
  PoseErrors absolute;   ///< of matched
  std::vector<TrajectoryRow> rows;
};

/// Pairs the poses, lays the estimate onto the truth by all pairs, and compares. Relative errors without a
/// pair of poses so far apart have n 0. Throws std::invalid_argument for options out of range, where no pose
/// finds a partner (naming how far off the nearest is), and what truthFromEstimate() throws.
TrajectoryEvaluation evaluateTrajectory(const Trajectory& truth, const Trajectory& estimate,
                                        const TrajectoryOptions& options);

/// Where the alignment's rotation is so loose that ate_deg may tell of it alone (beyond 0.2 rad), what to say
/// of that; else empty.
std::string doubtOfAlignment(const TrajectoryEvaluation& evaluation);

/// trajectory.csv: metric,unit,n,unmatched,rmse,mean,median,std,min,max,sse, a line for each row; unmatched:
/// poses of the estimate without a partner. "nan" for what is undefined. In one step.
void writeTrajectoryTable(const std::string& path, const TrajectoryEvaluation& evaluation);

/// Every pose of both files, by time: stamp,truth_stamp,x,y,z,ate,ate_deg, with the stamp and the aligned
/// position of the estimate. A pose of the estimate without a partner has no truth_stamp, one of the truth
/// has nothing but it. In one step.
void writePoseErrors(const std::string& path, const Trajectory& truth, const Trajectory& estimate,
                     const TrajectoryEvaluation& evaluation);

}  // namespace sunlit::evaluate
