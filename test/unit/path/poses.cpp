// The paper's rule on paths whose poses can be worked out with pencil and paper.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "sunlit/path/path.h"
#include "sunlit/quantity/angle.h"
#include "support/message_of.h"

namespace sunlit::path {
namespace {

// Positions are sums and products of a few doubles below 1000: rounding stays below 1e-12 m.
constexpr double kRounding = 1e-12;

void expectAt(const Eigen::Isometry3d& pose, const Eigen::Vector3d& position) {
  EXPECT_NEAR((pose.translation() - position).norm(), 0.0, kRounding) << pose.translation().transpose();
}

double yawOf(const Eigen::Isometry3d& pose) {
  return std::atan2(pose.linear()(1, 0), pose.linear()(0, 0));
}

std::string messageOf(const Waypoints& waypoints, const PathOptions& options = {}) {
  return sunlit::messageOf([&] { posesAlong(waypoints, options); });
}

TEST(PosesAlong, StartAgainAtEachWaypoint) {
  // 2.5 m east, then 1.2 m north: at 0, 1, 2 m of the first segment and at 0, 1 m of the second.
  const auto poses = posesAlong({{0, 0, 0}, {2.5, 0, 0}, {2.5, 1.2, 0}}, {1.0, 1.5});
  ASSERT_EQ(poses.size(), 5u);
  expectAt(poses[0], {0, 0, 1.5});
  expectAt(poses[1], {1, 0, 1.5});
  expectAt(poses[2], {2, 0, 1.5});
  expectAt(poses[3], {2.5, 0, 1.5});
  expectAt(poses[4], {2.5, 1, 1.5});
}

TEST(PosesAlong, FaceTheNextWaypoint) {
  const auto poses = posesAlong({{0, 0, 0}, {1.5, 0, 0}, {1.5, 1.5, 0}, {0, 1.5, 0}, {-1, 0.5, 0}}, {});
  ASSERT_EQ(poses.size(), 8u);
  EXPECT_NEAR(yawOf(poses[1]), 0.0, kRounding);            // the last before the turn still looks east
  EXPECT_NEAR(yawOf(poses[2]), 0.5 * kPi, kRounding);      // at the turn already north
  EXPECT_NEAR(std::abs(yawOf(poses[4])), kPi, kRounding);  // west
  EXPECT_NEAR(yawOf(poses[6]), -0.75 * kPi, kRounding);    // south-west
}

TEST(PosesAlong, NeverReachTheLastWaypoint) {
  // Exactly 10 m: the tenth metre is the end, which has no next segment to start.
  const auto poses = posesAlong({{0, 0, 0}, {10, 0, 0}}, {});
  ASSERT_EQ(poses.size(), 10u);
  expectAt(poses.back(), {9, 0, 1});
}

TEST(PosesAlong, CountIsExactWhereTheLengthIsAMultipleOfTheSpacing) {
  // 0.1 and 10 / 0.1 are not exact in binary; the count must not depend on which way they round.
  EXPECT_EQ(posesAlong({{0, 0, 0}, {10, 0, 0}}, {0.1, 0.0}).size(), 100u);
  EXPECT_EQ(posesAlong({{0, 0, 0}, {0.3, 0, 0}}, {0.1, 0.0}).size(), 3u);
  EXPECT_EQ(posesAlong({{0, 0, 0}, {3, 4, 0}}, {}).size(), 5u);
  for (int degrees = 0; degrees < 360; ++degrees) {
    const Angle heading = Angle::degrees(degrees);
    const Eigen::Vector3d end(100.0 + 7.0 * cos(heading), 200.0 + 7.0 * sin(heading), 0.0);
    EXPECT_EQ(posesAlong({{100, 200, 0}, end}, {}).size(), 7u) << degrees;
    EXPECT_EQ(posesAlong({{100, 200, 0}, end}, {0.7, 0.0}).size(), 10u) << degrees;
  }
}

TEST(PosesAlong, AnyRestBeyondTheSpacingGivesAPose) {
  EXPECT_EQ(posesAlong({{0, 0, 0}, {10.001, 0, 0}}, {}).size(), 11u);
  EXPECT_EQ(posesAlong({{0, 0, 0}, {9.999, 0, 0}}, {}).size(), 10u);
}

TEST(PosesAlong, ASegmentShorterThanTheSpacingHasItsStart) {
  const auto poses = posesAlong({{0, 0, 0}, {0.002, 0, 0}, {0.002, 0.5, 0}}, {1.0, 0.0});
  ASSERT_EQ(poses.size(), 2u);
  expectAt(poses[1], {0.002, 0, 0});
}

TEST(PosesAlong, StayLevelOnASlope) {
  // 4 m east and 3 m up: 5 m along the road, so each metre of road is 0.8 m east and 0.6 m up.
  const auto poses = posesAlong({{0, 0, 0}, {4, 0, 3}}, {1.0, 2.0});
  ASSERT_EQ(poses.size(), 5u);
  expectAt(poses[1], {0.8, 0, 2.6});
  for (const auto& pose : poses) {
    EXPECT_EQ((pose.linear().col(2) - Eigen::Vector3d::UnitZ()).norm(), 0.0);  // up stays up
    EXPECT_EQ(pose.linear()(2, 0), 0.0);                                       // forward stays horizontal
  }
}

TEST(PosesAlong, LieBesideThePathAndLookAside) {
  PathOptions options;
  options.offset_m = 0.5;
  options.yaw = Angle::degrees(30.0);
  const Waypoints corner{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}};
  const auto poses = posesAlong(corner, options);
  ASSERT_EQ(poses.size(), posesAlong(corner, {}).size());
  // Eastward, left is north; northward, it is west. Cosine and sine of 30 and of 120 degrees.
  EXPECT_TRUE(poses[1].translation().isApprox(Eigen::Vector3d(1.0, 0.5, 1.0)));
  EXPECT_TRUE(poses[1].linear().col(0).isApprox(Eigen::Vector3d(std::sqrt(0.75), 0.5, 0.0)));
  EXPECT_TRUE(poses[3].translation().isApprox(Eigen::Vector3d(1.5, 1.0, 1.0)));
  EXPECT_TRUE(poses[3].linear().col(0).isApprox(Eigen::Vector3d(-0.5, std::sqrt(0.75), 0.0)));
  EXPECT_TRUE(poses[3].linear().col(2).isApprox(Eigen::Vector3d::UnitZ()));
}

TEST(DriveOf, TellsDrivesBesideThePathApart) {
  const auto driveAt = [](double offset_m, double yaw_deg) {
    PathOptions options;
    options.offset_m = offset_m;
    options.yaw = Angle::degrees(yaw_deg);
    return driveOf(options);
  };
  EXPECT_EQ(driveAt(0.0, 0.0), "");
  EXPECT_EQ(driveAt(-0.0, -0.0), "");
  EXPECT_EQ(driveAt(0.5, 10.0), "offset 0.5 m, yaw 10 deg");
  EXPECT_EQ(driveAt(-0.0, -7.3), "offset 0 m, yaw -7.3 deg");
}

TEST(PosesAlong, RefusesWhatIsNoPath) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(messageOf({}), "a path needs two waypoints or more, there are 0");
  EXPECT_EQ(messageOf({{1, 2, 3}}), "a path needs two waypoints or more, there is 1");
  EXPECT_EQ(messageOf({{0, 0, 0}, {1, nan, 0}}),
            "waypoint 1: y is nan, but must be from -10000000 to 10000000 m");
  EXPECT_EQ(messageOf({{0, 0, 0}, {1, 0, -1e300}}),
            "waypoint 1: z is -1e+300, but must be from -10000000 to 10000000 m");
  EXPECT_EQ(messageOf({{0, 0, 0}, {20000, 0, 0}}, {0.001, 0.0}),
            "waypoint 0: from here to the next are 20000.000000 m, more poses than the 10 million allowed");
  // Straight above each other is no direction to look in, either.
  EXPECT_EQ(messageOf({{0, 0, 0}, {1, 0, 0}, {1, 0.0009, 5}}),
            "waypoint 2: it is less than 1 mm from the waypoint before it in plan view; leave it out");
}

/// As many waypoints along x, these far apart.
Waypoints apart(const std::vector<double>& steps_m) {
  Waypoints waypoints{{0, 0, 0}};
  for (const double step_m : steps_m)
    waypoints.emplace_back(waypoints.back() + Eigen::Vector3d(step_m, 0, 0));
  return waypoints;
}

TEST(CrowdedText, TellsOfWaypointsALittleFartherApartThanASpacing) {
  const Waypoints eleven = apart({1.2, 1.204, 1.21, 1.22, 1.204, 1.206, 1.21, 1.211, 1.217, 1.217});
  ASSERT_EQ(posesAlong(eleven, {1.2, 0.0}).size(), 19U);
  EXPECT_EQ(
      crowdedText(eleven, {1.2, 0.0}),
      "8 of 19 poses lie less than a tenth of the spacing behind the one before, since waypoints are 1.2 to "
      "1.22 m apart: a spacing of 1.3 m takes one a waypoint");
  EXPECT_EQ(posesAlong(eleven, {1.3, 0.0}).size(), 10U);
  EXPECT_EQ(crowdedText(eleven, {1.3, 0.0}), "");
  EXPECT_EQ(crowdedText(eleven, {1.0, 0.0}), "") << "a fifth of a spacing is no crowd";
  EXPECT_EQ(
      crowdedText(apart({4.01, 4.01, 4.01}), {2.0, 0.0}),
      "2 of 9 poses lie less than a tenth of the spacing behind the one before, since waypoints are 4.01 m "
      "apart");
  EXPECT_EQ(crowdedText(apart({1.0, 1.0, 1.0}), {1.0, 0.0}), "");
  EXPECT_EQ(crowdedText(apart({1.01}), {1.0, 0.0}), "") << "no pose follows there";
}

TEST(WithoutStandstills, KeepsTheFirstOfEachPlaceAndLosesNoWayOfWhatCreeps) {
  const Waypoints still = {{0, 0, 0}, {0, 0, 5}, {0, 0.0009, 0}, {0, 0.0018, 0}, {1, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(withoutStandstills(still), (Waypoints{{0, 0, 0}, {0, 0.0018, 0}, {1, 0, 0}}));
  EXPECT_EQ(withoutStandstills({}), Waypoints());
  EXPECT_EQ(leftOutText(1), "1 pose left out, less than 1 mm in plan view from the one before");
}

TEST(WithoutStandstills, NamesAWaypointByItsPlaceAmongAll) {
  try {
    withoutStandstills({{0, 0, 0}, {0, 0, 0}, {1, 2e7, 0}});
    ADD_FAILURE();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "waypoint 2: y is 20000000, but must be from -10000000 to 10000000 m");
  }
}

TEST(MotionAt, IsOfOneSpeedAndTurnsWithinASpacing) {
  // Poses 2 m apart at x = 0, 2, 4 and, round the corner at (5, 0) to the left, at y = 0, 2.
  const std::vector<Eigen::Isometry3d> poses = posesAlong({{0, 0, 0}, {5, 0, 0}, {5, 3, 0}}, {2.0, 0.0});
  ASSERT_EQ(poses.size(), 5U);
  Pace pace{10.0, 4.0, 2.0};
  const auto expectMotion = [&](int index, const Eigen::Vector3d& velocity_m_s, double left_rad_s) {
    const Motion motion = motionAt(poses, index, pace);
    EXPECT_NEAR((motion.velocity_m_s - velocity_m_s).norm(), 0.0, kRounding) << index;
    EXPECT_NEAR((motion.turning_rad_s - Eigen::Vector3d(0, 0, left_rad_s)).norm(), 0.0, kRounding) << index;
  };
  expectMotion(0, {4, 0, 0}, 0.0);
  expectMotion(1, {4, 0, 0}, 0.0);
  expectMotion(2, {4, 0, 0},
               0.5 * kPi / 0.5);  // a quarter turn while it drives 2 m, though the next is 1 m away
  expectMotion(3, {0, 4, 0}, 0.0);
  expectMotion(4, {0, 4, 0}, 0.0);
  pace.speed_m_s.reset();  // 2 m in 0.1 s
  expectMotion(2, {20, 0, 0}, 0.5 * kPi / 0.1);
  pace.speed_m_s = 0.0;
  expectMotion(2, {0, 0, 0}, 0.0);
  pace.speed_m_s = 1.0;
  EXPECT_TRUE(motionAt({poses[0]}, 0, pace).none());
  EXPECT_TRUE(motionAt({}, 0, pace).none());
}

TEST(MotionAt, OfALastPoseAloneOnItsSegmentGoesWhereThatLeads) {
  // Of 1 m and less, which the pose at its start is all of.
  const std::vector<Eigen::Isometry3d> poses = posesAlong({{0, 0, 0}, {3, 0, 0}, {3, 1, 0}}, {1.0, 0.0});
  ASSERT_EQ(poses.size(), 4U);
  const Motion motion = motionAt(poses, 3, {10.0, 4.0, 1.0});
  EXPECT_NEAR((motion.velocity_m_s - Eigen::Vector3d(0, 4, 0)).norm(), 0.0, kRounding);
  EXPECT_TRUE(motion.turning_rad_s.isZero(0.0));
  PathOptions turned{1.0, 0.0};
  turned.yaw = Angle::degrees(90.0);  // the camera looks to the left of where it goes
  const auto aside = posesAlong({{0, 0, 0}, {0.5, 0, 0}, {0.5, 0.5, 0}}, turned);
  ASSERT_EQ(aside.size(), 2U);
  EXPECT_NEAR((motionAt(aside, 1, {10.0, 1.0, 1.0}).velocity_m_s - Eigen::Vector3d::UnitY()).norm(), 0.0,
              kRounding);
}

TEST(MotionAt, GoesAlongAndNotAcrossBesideThePath) {
  PathOptions beside{1.0, 0.0};
  beside.offset_m = 2.0;  // whose poses at a corner are apart
  const std::vector<Eigen::Isometry3d> poses = posesAlong({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}}, beside);
  const Motion motion = motionAt(poses, 1, {10.0, 1.0, 1.0});
  EXPECT_NEAR((motion.velocity_m_s - Eigen::Vector3d::UnitX()).norm(), 0.0, kRounding);
}

TEST(PoseSelection, EndsWithThePathOrItsCount) {
  EXPECT_EQ((PoseSelection{}.end(991)), 991);
  EXPECT_EQ((PoseSelection{20, 0, 3}.end(991)), 991);
  EXPECT_EQ((PoseSelection{20, 40, 3}.end(991)), 60);
}

TEST(PoseSelection, IsRefusedBeyondThePath) {
  const auto said = [](const PoseSelection& selection) {
    return sunlit::messageOf([&] { requireWithin(selection, 10, "--"); });
  };
  for (const PoseSelection& good : {PoseSelection{0, 10, 1}, {9, 0, 5}, {9, 1, 1}}) EXPECT_EQ(said(good), "");
  EXPECT_EQ(said({10, 0, 1}), "--first 10 and --count 0 ask for more than the path's 10 poses");
  EXPECT_EQ(said({3, 8, 1}), "--first 3 and --count 8 ask for more than the path's 10 poses");
}

TEST(PathStamps, KeepTheirNanoseconds) {
  EXPECT_EQ(nanosecondsTo(0, 10.0), 0);
  EXPECT_EQ(nanosecondsTo(1, 30.0), 33333333);
  EXPECT_EQ(nanosecondsTo(2, 30.0), 66666667);
  EXPECT_EQ(nanosecondsTo(86400001, 1000.0), 86400001000000);  // a day
}

TEST(PathOptions, NameKeyValueAndRange) {
  const Waypoints waypoints{{0, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(messageOf(waypoints, {0.0, 1.0}), "spacing is 0, but must be from 0.001 to 1000 m");
  EXPECT_EQ(messageOf(waypoints, {1.0, 2e3}), "camera_height is 2000, but must be from -1000 to 1000 m");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(validate(PathOptions{nan, 1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sunlit::path
