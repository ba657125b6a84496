// Errors that can be worked out on paper.
#include "sunlit/evaluate/trajectory/pose_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "sunlit/quantity/angle.h"
#include "support/message_of.h"

namespace sunlit::evaluate {
namespace {

StampedPose pose(const Eigen::Vector3d& position, double yaw_deg = 0.0) {
  StampedPose pose;
  pose.position = position;
  pose.orientation = Eigen::AngleAxisd(yaw_deg * kRadPerDeg, Eigen::Vector3d::UnitZ());
  return pose;
}

Trajectory alongX(const std::vector<double>& xs) {
  Trajectory trajectory;
  for (const double x : xs) trajectory.push_back(pose({x, 0, 0}));
  return trajectory;
}

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

Pairs pairsOf(const Trajectory& truth, const std::string& delta) {
  Pairs pairs;
  for (const IndexPair& pair : pairsApart(truth, parseDelta(delta)))
    pairs.emplace_back(pair.first, pair.second);
  return pairs;
}

void expectNear(const std::vector<double>& actual, const std::vector<double>& expected, double tolerance) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) EXPECT_NEAR(actual[i], expected[i], tolerance) << i;
}

TEST(AbsoluteErrors, AreDistanceAndAngle) {
  const MatchedPoses poses{{pose({0, 0, 0}), pose({1, 1, 1}, 170), pose({2, 0, 0}, 10)},
                           {pose({3, 4, 0}), pose({1, 1, 1}, -170), pose({2, 0, 12}, 190)}};
  const PoseErrors errors = absoluteErrors(poses);
  EXPECT_EQ(errors.translation_m, (std::vector<double>{5, 0, 12}));
  expectNear(errors.rotation_deg, {0, 20, 180}, 1e-12);
}

TEST(AbsoluteErrors, KnowTheSmallestAngles) {
  // 1e-9°: by the cosine nothing would be left of it.
  const PoseErrors errors = absoluteErrors({{pose({0, 0, 0}, 30)}, {pose({0, 0, 0}, 30 + 1e-9)}});
  EXPECT_NEAR(errors.rotation_deg[0], 1e-9, 1e-14);
}

TEST(AbsoluteErrors, AQuaternionAndItsNegativeAreOneRotation) {
  MatchedPoses poses{{pose({0, 0, 0}, 50)}, {pose({0, 0, 0}, 50)}};
  poses.estimate[0].orientation.coeffs() *= -1.0;
  EXPECT_NEAR(absoluteErrors(poses).rotation_deg[0], 0.0, 1e-13);
}

TEST(PairsApart, ByFramesFollowOneAnother) {
  const Trajectory truth = alongX({0, 1, 2, 3, 4, 5});
  EXPECT_EQ(pairsOf(truth, "1frame"), (Pairs{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}}));
  EXPECT_EQ(pairsOf(truth, "2frames"), (Pairs{{0, 2}, {2, 4}}));
  EXPECT_EQ(pairsOf(truth, "5frames"), (Pairs{{0, 5}}));
  EXPECT_EQ(pairsOf(truth, "6frames"), Pairs());
}

TEST(PairsApart, ByMetresCountThePathSinceTheLastOne) {
  EXPECT_EQ(pairsOf(alongX({0, 0.75, 1.5, 2.25, 3.0, 3.75, 4.5}), "1m"), (Pairs{{2, 4}, {4, 6}}));
  // There and back: the path grows, though the place does not.
  EXPECT_EQ(pairsOf(alongX({0, 1, 0, 1, 0}), "2m"), (Pairs{{2, 4}}));
  EXPECT_EQ(pairsOf(alongX({0, 1, 2, 3}), "1m"), (Pairs{{1, 2}, {2, 3}}));
  EXPECT_EQ(pairsOf(alongX({0, 1, 2, 3}), "2m"), Pairs());
  EXPECT_EQ(pairsOf(alongX({5}), "1m"), Pairs());
}

TEST(RelativeErrors, OfAnOdometerThatCountsATenthTooMuch) {
  const MatchedPoses poses{alongX({0, 1, 2, 3}), alongX({0, 1.125, 2.25, 3.375})};
  EXPECT_EQ(relativeErrors(poses, parseDelta("1frame"), PathOf::kTruth).translation_m,
            (std::vector<double>{0.125, 0.125, 0.125}));
  EXPECT_EQ(relativeErrors(poses, parseDelta("1m"), PathOf::kTruth).translation_m,
            (std::vector<double>{0.125, 0.125}));
  EXPECT_EQ(relativeErrors(poses, parseDelta("3frames"), PathOf::kTruth).translation_m,
            (std::vector<double>{0.375}));
  EXPECT_EQ(relativeErrors(poses, parseDelta("1frame"), PathOf::kTruth).rotation_deg,
            (std::vector<double>{0, 0, 0}));
}

TEST(RelativeErrors, CountMetresAlongThePathThatIsAskedFor) {
  // By its own path of 0.625 m a pose the estimate pairs every second one, by the true one each.
  const MatchedPoses poses{alongX({0, 1, 2, 3, 4}), alongX({0, 0.625, 1.25, 1.875, 2.5})};
  EXPECT_EQ(relativeErrors(poses, parseDelta("1m"), PathOf::kTruth).translation_m,
            (std::vector<double>{0.375, 0.375, 0.375}));
  EXPECT_EQ(relativeErrors(poses, parseDelta("1m"), PathOf::kEstimate).translation_m,
            (std::vector<double>{0.75}));
}

TEST(RelativeErrors, AreSeenFromTheFirstPoseOfThePair) {
  // Truth: 1 m ahead, then 1 m ahead. Estimate: the same, but it took a left turn of 90° before, of which the
  // second pair's motion, in its own frame, knows nothing; the first pair has the turn as its error.
  const MatchedPoses poses{{pose({0, 0, 0}), pose({1, 0, 0}), pose({2, 0, 0})},
                           {pose({0, 0, 0}), pose({1, 0, 0}, 90), pose({1, 1, 0}, 90)}};
  const PoseErrors errors = relativeErrors(poses, parseDelta("1frame"), PathOf::kTruth);
  expectNear(errors.translation_m, {0, 0}, 1e-15);
  expectNear(errors.rotation_deg, {90, 0}, 1e-13);
  // Absolute errors know it: √2 m between (2, 0) and (1, 1).
  expectNear(absoluteErrors(poses).translation_m, {0, 0, std::sqrt(2.0)}, 1e-15);
}

TEST(RelativeErrors, DoNotDependOnWhereTheEstimateBegins) {
  std::mt19937_64 generator(31);
  std::normal_distribution<double> normal;
  const auto random = [&] {
    StampedPose pose;
    pose.position = {normal(generator), normal(generator), normal(generator)};
    const double w = normal(generator), x = normal(generator), y = normal(generator), z = normal(generator);
    pose.orientation = Eigen::Quaterniond(w, x, y, z).normalized();
    return pose;
  };
  MatchedPoses poses;
  for (int i = 0; i < 20; ++i) {
    poses.truth.push_back(random());
    poses.estimate.push_back(random());
  }
  const PoseErrors before = relativeErrors(poses, parseDelta("1frame"), PathOf::kTruth);
  const StampedPose shift = random();
  poses.estimate = aligned({1.0, shift.orientation.toRotationMatrix(), shift.position}, poses.estimate);
  const PoseErrors after = relativeErrors(poses, parseDelta("1frame"), PathOf::kTruth);
  expectNear(after.translation_m, before.translation_m, 1e-13);
  expectNear(after.rotation_deg, before.rotation_deg, 1e-12);
}

TEST(RelativeErrors, EqualTheProductOfMatrices) {
  // Sturm et al., eq. 1, as it is written.
  const MatchedPoses poses{{pose({1, 2, 3}, 20), pose({4, -1, 2}, 75)},
                           {pose({0, 1, 0}, -40), pose({2, 2, 2}, 60)}};
  const auto matrix = [](const StampedPose& p) {
    return Eigen::Isometry3d(Eigen::Translation3d(p.position) * p.orientation);
  };
  const Eigen::Isometry3d error = (matrix(poses.truth[0]).inverse() * matrix(poses.truth[1])).inverse() *
                                  (matrix(poses.estimate[0]).inverse() * matrix(poses.estimate[1]));
  const PoseErrors errors = relativeErrors(poses, parseDelta("1frame"), PathOf::kTruth);
  EXPECT_NEAR(errors.translation_m[0], error.translation().norm(), 1e-14);
  EXPECT_NEAR(errors.rotation_deg[0], Eigen::AngleAxisd(error.linear()).angle() / kRadPerDeg, 1e-12);
  EXPECT_NEAR(errors.rotation_deg[0], 45.0, 1e-12);
}

TEST(Delta, HasANameThatCanBeRead) {
  for (const std::string name : {"1m", "10m", "0.5m", "1frame", "25frame"})
    EXPECT_EQ(parseDelta(name).name(), name);
  EXPECT_EQ(parseDelta("25frames").name(), "25frame");
  for (const std::string bad :
       {"", "m", "1", "0m", "-1m", "nanm", "0frame", "1.5frames", "1km", "1m,", "1m 2"})
    EXPECT_EQ(messageOf([&] { parseDelta(bad); }),
              "delta is \"" + bad +
                  "\", but must be metres above 0, such as 10m, or whole frames from 1, such as 1frame");
  EXPECT_NE(messageOf([] { pairsApart({}, {0.0, Delta::Unit::kMetres}); }), "");
  EXPECT_NE(messageOf([] { pairsApart({}, {0.5, Delta::Unit::kFrames}); }), "");
}

TEST(ErrorStatistics, AreThoseOfATextbookExample) {
  const ErrorStatistics s = statisticsOfErrors({9, 2, 4, 5, 4, 4, 5, 7});
  EXPECT_EQ(s.n, 8u);
  EXPECT_EQ(s.mean, 5.0);
  EXPECT_EQ(s.std, 2.0);  // divided by n: 32 / 8
  EXPECT_EQ(s.median, 4.5);
  EXPECT_EQ(s.min, 2.0);
  EXPECT_EQ(s.max, 9.0);
  EXPECT_EQ(s.sse, 232.0);
  EXPECT_EQ(s.rmse, std::sqrt(29.0));
  EXPECT_EQ(statisticsOfErrors({3, 1, 2}).median, 2.0);
}

TEST(ErrorStatistics, OfNothingAreUndefined) {
  const ErrorStatistics s = statisticsOfErrors({});
  EXPECT_EQ(s.n, 0u);
  EXPECT_EQ(s.sse, 0.0);
  for (const double value : {s.rmse, s.mean, s.median, s.std, s.min, s.max}) EXPECT_TRUE(std::isnan(value));
}

}  // namespace
}  // namespace sunlit::evaluate
