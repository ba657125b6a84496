// The whole way from two trajectories to a table.
#include "sunlit/evaluate/trajectory/trajectory_evaluation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace sunlit::evaluate {
namespace {

constexpr std::int64_t kSecond = 1000000000;

/// One pose a second, 1 m apart along x.
Trajectory straight(std::int64_t poses) {
  Trajectory trajectory(static_cast<std::size_t>(poses));
  for (std::int64_t i = 0; i < poses; ++i) {
    trajectory[static_cast<std::size_t>(i)].stamp_ns = i * kSecond;
    trajectory[static_cast<std::size_t>(i)].position = {static_cast<double>(i), 0, 0};
  }
  return trajectory;
}

TEST(TrajectoryEvaluation, OfTheTruthItselfIsZero) {
  const TrajectoryEvaluation result = evaluateTrajectory(straight(30), straight(30), {});
  const std::map<std::string, std::size_t> expected{
      {"ate", 30},    {"ate_deg", 30},    {"rpe_1m", 28},     {"rpe_1m_deg", 28},
      {"rpe_10m", 1}, {"rpe_10m_deg", 1}, {"rpe_1frame", 29}, {"rpe_1frame_deg", 29}};
  std::map<std::string, std::size_t> found;
  for (const TrajectoryRow& row : result.rows) {
    found[row.metric] = row.statistics.n;
    EXPECT_EQ(row.statistics.rmse, 0.0) << row.metric;
    EXPECT_EQ(row.unit, row.metric.find("_deg") == std::string::npos ? "m" : "deg");
  }
  EXPECT_EQ(found, expected);
}

TEST(TrajectoryEvaluation, LeavesOutAndCountsWhatHasNoPartner) {
  Trajectory estimate = straight(12);
  estimate[3].stamp_ns += 20000000;  // twice as far off as is allowed
  estimate[3].position.y() = 1e6;    // which nobody sees
  estimate[7].stamp_ns -= 10000000;  // just near enough
  estimate[7].position.y() = 2.0;
  Trajectory truth = straight(11);
  const TrajectoryEvaluation result = evaluateTrajectory(truth, estimate, {});
  EXPECT_EQ(result.association.estimate_left, (std::vector<std::size_t>{3, 11}));
  EXPECT_EQ(result.association.truth_left, (std::vector<std::size_t>{3}));
  EXPECT_EQ(result.rows[0].statistics.n, 10u);
  EXPECT_EQ(result.rows[0].statistics.max, 2.0);
  EXPECT_EQ(result.rows[0].statistics.sse, 4.0);
}

TEST(TrajectoryEvaluation, RefusesTrajectoriesOfDifferentTimes) {
  Trajectory late = straight(3);
  for (StampedPose& pose : late) pose.stamp_ns += 3600 * kSecond;
  EXPECT_EQ(messageOf([&] { evaluateTrajectory(straight(3), late, {}); }),
            "no pose of the estimate has one of the truth within 0.01 s: the nearest are 3598 s apart");
}

TEST(TrajectoryEvaluation, RefusesWhatCannotBeAligned) {
  TrajectoryOptions options;
  options.align = Alignment::kSim3;
  EXPECT_NE(messageOf([&] { evaluateTrajectory(straight(9), straight(9), options); }).find("on one line"),
            std::string::npos);
  options.align = Alignment::kYaw;
  EXPECT_NO_THROW(evaluateTrajectory(straight(9), straight(9), options));
  EXPECT_NE(messageOf([&] { evaluateTrajectory(straight(9), straight(1), options); }).find("needs 2 pairs"),
            std::string::npos);
  EXPECT_EQ(messageOf([&] { evaluateTrajectory(straight(9), {}, options); }), "a trajectory without poses");
}

TEST(TrajectoryEvaluation, RefusesOptionsOutOfRange) {
  TrajectoryOptions options;
  options.max_difference_s = -0.01;
  EXPECT_EQ(messageOf([&] { evaluateTrajectory(straight(3), straight(3), options); }),
            "max_difference is -0.01, but must be from 0 to 1000000 s");
}

TEST(TrajectoryEvaluation, ComparesTheAlignedEstimate) {
  Trajectory truth = straight(5);
  truth[2].position.y() = 2.0;  // off the line
  const Similarity half{
      0.5, Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, 2) / 3.0).toRotationMatrix(), {7, 8, 9}};
  TrajectoryOptions options;
  options.align = Alignment::kSim3;
  options.deltas = {{2.0, Delta::Unit::kFrames}};
  const TrajectoryEvaluation result = evaluateTrajectory(truth, aligned(half, truth), options);
  EXPECT_NEAR(result.truth_from_estimate.scale, 2.0, 1e-14);
  ASSERT_EQ(result.rows.size(), 4u);
  EXPECT_EQ(result.rows[2].metric, "rpe_2frame");
  for (const TrajectoryRow& row : result.rows) EXPECT_LT(row.statistics.max, 1e-13) << row.metric;
}

TEST(TrajectoryTable, HasTheColumnsThatPeopleReadItBy) {
  const TemporaryFolder folder;
  Trajectory estimate = straight(4);
  estimate[1].position.y() = 3.0;
  estimate[2].stamp_ns += kSecond / 2;
  TrajectoryOptions options;
  options.deltas = {{10.0, Delta::Unit::kMetres}};
  const Trajectory truth = straight(4);
  const TrajectoryEvaluation result = evaluateTrajectory(truth, estimate, options);
  writeTrajectoryTable(folder.file("trajectory.csv"), result);
  EXPECT_EQ(contentOf(folder.file("trajectory.csv")),
            "metric,unit,n,unmatched,rmse,mean,median,std,min,max,sse\n"
            "ate,m,3,1,1.7320508075688772,1,0,1.4142135623730951,0,3,9\n"
            "ate_deg,deg,3,1,0,0,0,0,0,0,0\n"
            "rpe_10m,m,0,1,nan,nan,nan,nan,nan,nan,0\n"
            "rpe_10m_deg,deg,0,1,nan,nan,nan,nan,nan,nan,0\n");
  writePoseErrors(folder.file("poses.csv"), truth, estimate, result);
  EXPECT_EQ(contentOf(folder.file("poses.csv")),
            "stamp,truth_stamp,x,y,z,ate,ate_deg\n"
            "0.000000000,0.000000000,0,0,0,0,0\n"
            "1.000000000,1.000000000,1,3,0,3,0\n"
            ",2.000000000,,,,,\n"
            "2.500000000,,2,0,0,,\n"
            "3.000000000,3.000000000,3,0,0,0,0\n");
}

}  // namespace
}  // namespace sunlit::evaluate
