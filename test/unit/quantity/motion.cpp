#include "sunlit/quantity/motion.h"

#include <gtest/gtest.h>

#include "sunlit/quantity/angle.h"

namespace sunlit {
namespace {

Eigen::Isometry3d poseAt(const Eigen::Vector3d& place, double yaw_deg) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = place;
  pose.linear() = Eigen::AngleAxisd(yaw_deg * kRadPerDeg, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return pose;
}

TEST(Motion, GoesFromOnePoseToTheNextInItsTime) {
  const Eigen::Isometry3d first = poseAt({1.0, 2.0, 3.0}, 170.0), second = poseAt({2.0, 2.0, 3.5}, -170.0);
  const Motion motion = Motion::between(first, second, 0.1);
  EXPECT_TRUE(motion.velocity_m_s.isApprox(Eigen::Vector3d(10.0, 0.0, 5.0)));
  // By the shortest turn: 20° to the left in a tenth of a second.
  EXPECT_TRUE(motion.turning_rad_s.isApprox(Eigen::Vector3d(0.0, 0.0, 200.0 * kRadPerDeg), 1e-12));
  const auto after = [&](double s) {
    return Eigen::Isometry3d(motion.after(s, first.translation()) * first);
  };
  EXPECT_TRUE(after(0.1).isApprox(second, 1e-12));
  EXPECT_TRUE(after(0.05).isApprox(poseAt({1.5, 2.0, 3.25}, 180.0), 1e-12));
  EXPECT_TRUE(after(-0.05).isApprox(poseAt({0.5, 2.0, 2.75}, 160.0), 1e-12));
  EXPECT_TRUE(after(0.0).isApprox(first, 0.0));
}

TEST(Motion, OfWhatStandsIsNone) {
  const Eigen::Isometry3d pose = poseAt({1.0, 2.0, 3.0}, 70.0);
  EXPECT_TRUE(Motion().none());
  EXPECT_TRUE(Motion::between(pose, pose, 0.1).none());
}

}  // namespace
}  // namespace sunlit
