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

/// A rise on an ellipse, and an estimate that is smaller, turned, moved, rough, and slow in time.
MatchedPoses rise() {
  MatchedPoses poses;
  for (int i = 0; i < 100; ++i) {
    const double a = 0.06 * i;
    StampedPose truth, estimate;
    truth.stamp_ns = i * (kSecond / 10);
    truth.position = {10 * std::cos(a), 7 * std::sin(a), 0.5 * a};
    truth.orientation = Eigen::AngleAxisd(0.03 * i, Eigen::Vector3d(1, 2, 2).normalized());
    estimate.stamp_ns = truth.stamp_ns + std::llround(3e6 * std::sin(5.0 * i));
    const Eigen::Vector3d rough =
        truth.position + 0.05 * Eigen::Vector3d(std::sin(13.0 * i), std::sin(17.0 * i), std::sin(19.0 * i));
    estimate.position = Eigen::Vector3d(0.8 * rough.x() + 1, -0.8 * rough.z() + 2, 0.8 * rough.y() + 3);
    estimate.orientation = Eigen::AngleAxisd(0.031 * i, Eigen::Vector3d(1, 2, 2.5).normalized());
    poses.truth.push_back(truth);
    poses.estimate.push_back(estimate);
  }
  return poses;
}

struct EvoRow {
  Alignment align;
  const char* metric;
  std::size_t n;
  double values[7];  ///< rmse, mean, median, std, min, max, sse
};

// What evo 1.36.5 says of rise(): APE, and RPE of consecutive pairs with pairs_from_reference.
const EvoRow kEvo[] = {
    {Alignment::kNone,
     "ate",
     100,
     {7.0188295618, 6.718001932, 7.0237362727, 2.0328350793, 2.8639005536, 9.6880534074, 4926.3968418}},
    {Alignment::kNone,
     "ate_deg",
     100,
     {9.4276889214, 8.4160261586, 9.1873474112, 4.2487435904, 0, 13.939879165, 8888.1318399}},
    {Alignment::kNone,
     "rpe_1m",
     42,
     {0.89973407235, 0.78745124355, 0.69881971419, 0.43524928487, 0.25352354461, 1.5776973278, 33.99989884}},
    {Alignment::kNone,
     "rpe_1m_deg",
     42,
     {0.47219309825, 0.46324038586, 0.40536235223, 0.091513206382, 0.40536235223, 0.60793546994,
      9.3645855255}},
    {Alignment::kNone,
     "rpe_10m",
     4,
     {6.908229915, 6.1784323987, 5.2813579049, 3.0904067132, 2.9668584965, 11.184155289, 190.89456223}},
    {Alignment::kNone,
     "rpe_1frame",
     99,
     {0.37526350618, 0.35221523528, 0.36569183598, 0.12948794195, 0.11794863547, 0.57814458421,
      13.941447208}},
    {Alignment::kNone,
     "rpe_5frame",
     19,
     {1.8466711133, 1.7287123304, 1.6909824086, 0.64942118802, 0.6980567864, 2.677522785, 64.793689812}},
    {Alignment::kSe3,
     "ate",
     100,
     {1.719829897, 1.7062231169, 1.6826649684, 0.21591097694, 1.3685539079, 2.1134401481, 295.78148745}},
    {Alignment::kSe3,
     "ate_deg",
     100,
     {85.267151357, 85.15455462, 86.071661815, 4.3805168682, 77.225870585, 90.18412099, 727048.71006}},
    {Alignment::kSe3,
     "rpe_1m",
     42,
     {0.89973407235, 0.78745124355, 0.69881971419, 0.43524928487, 0.25352354461, 1.5776973278, 33.99989884}},
    {Alignment::kSe3,
     "rpe_1m_deg",
     42,
     {0.47219309825, 0.46324038586, 0.40536235223, 0.091513206382, 0.40536235223, 0.60793546994,
      9.3645855255}},
    {Alignment::kSe3,
     "rpe_10m",
     4,
     {6.908229915, 6.1784323987, 5.2813579049, 3.0904067132, 2.9668584965, 11.184155289, 190.89456223}},
    {Alignment::kSe3,
     "rpe_1frame",
     99,
     {0.37526350618, 0.35221523528, 0.36569183598, 0.12948794195, 0.11794863547, 0.57814458421,
      13.941447208}},
    {Alignment::kSe3,
     "rpe_5frame",
     19,
     {1.8466711133, 1.7287123304, 1.6909824086, 0.64942118802, 0.6980567864, 2.677522785, 64.793689812}},
    {Alignment::kSim3,
     "ate",
     100,
     {0.06030328277, 0.058604792816, 0.059060606654, 0.014211409919, 0.021507324162, 0.085562683236,
      0.36364859129}},
    {Alignment::kSim3,
     "rpe_1m",
     42,
     {0.96946300989, 0.82078481029, 0.73643444313, 0.5159174573, 0.11602875334, 1.743192173, 39.474058157}},
    {Alignment::kSim3,
     "rpe_10m",
     4,
     {7.4111515248, 6.4270834652, 5.4505573442, 3.6902256104, 2.4619047637, 12.345314409, 219.70066769}},
    {Alignment::kSim3,
     "rpe_1frame",
     99,
     {0.40363811883, 0.36842379371, 0.39188123755, 0.16488674658, 0.031667062437, 0.64976793469,
      16.129449366}},
    {Alignment::kSim3,
     "rpe_5frame",
     19,
     {1.98026232, 1.7990848053, 1.8000455782, 0.82748578185, 0.27239737013, 2.9535594961, 74.507338261}},
};

TEST(TrajectoryEvaluation, AgreesWithEvo) {
  const MatchedPoses poses = rise();
  TrajectoryOptions options;
  options.deltas.push_back({5.0, Delta::Unit::kFrames});
  options.pairs_from = PathOf::kTruth;
  for (const EvoRow& expected : kEvo) {
    options.align = expected.align;
    const TrajectoryEvaluation result = evaluateTrajectory(poses.truth, poses.estimate, options);
    for (const TrajectoryRow& row : result.rows) {
      if (row.metric != expected.metric) continue;
      const ErrorStatistics& s = row.statistics;
      const double values[] = {s.rmse, s.mean, s.median, s.std, s.min, s.max, s.sse};
      EXPECT_EQ(s.n, expected.n) << row.metric;
      // Eleven digits are written above; an angle of 0 is 0 but for the roundings of a quaternion, in
      // degrees.
      for (int k = 0; k < 7; ++k)
        EXPECT_NEAR(values[k], expected.values[k], 1e-10 * expected.values[k] + 1e-13)
            << row.metric << " " << k;
    }
  }
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
