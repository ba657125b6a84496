// The parts of the render node that need no master.
#include <gtest/gtest.h>

#include <limits>

#include "ros/render/messages.h"
#include "ros/render/options.h"
#include "ros/render/path_source.h"
#include "ros/render/run_log.h"
#include "ros/render/stopwatch.h"

namespace sunlit::ros_interface {
namespace {

TEST(StampOfPose, IsStartPlusIndexOverRateToTheNanosecond) {
  const ros::Time start(1000, 250000000);
  EXPECT_EQ(stampOfPose(start, 0, 10.0), start);
  EXPECT_EQ(stampOfPose(start, 7, 10.0), ros::Time(1000, 950000000));
  EXPECT_EQ(stampOfPose(start, 8, 10.0), ros::Time(1001, 50000000));
  EXPECT_EQ(stampOfPose(start, 1, 30.0), ros::Time(1000, 283333333));
  // A day at 1 kHz.
  EXPECT_EQ(stampOfPose(start, 86400000, 1000.0), ros::Time(1000 + 86400, 250000000));
}

TEST(StampOfPose, NeverRepeats) {
  ros::Time before = stampOfPose(ros::Time(1), 0, 59.94);
  for (int index = 1; index < 100000; ++index) {
    const ros::Time stamp = stampOfPose(ros::Time(1), index, 59.94);
    ASSERT_LT(before, stamp) << index;
    before = stamp;
  }
}

TEST(Messages, ADepthImageKeepsItsBits) {
  image::DepthImage depth(3, 2);
  depth.data = {1.5f, 2.5f, 3.5f, std::numeric_limits<float>::quiet_NaN(), 5.5f, 6.5f};
  const sensor_msgs::ImagePtr message = toImageMessage(depth, opticalHeader(ros::Time(5)));
  EXPECT_EQ(message->encoding, "32FC1");
  EXPECT_EQ(message->step, 12u);
  ASSERT_EQ(message->data.size(), 24u);
  EXPECT_EQ(std::memcmp(message->data.data(), depth.data.data(), 24), 0);
}

TEST(Messages, CameraInfoProjectsLikeTheCamera) {
  const auto camera = image::PinholeCamera::fromFieldOfView(64, 48, Angle::degrees(90.0));
  const sensor_msgs::CameraInfo info = toCameraInfo(camera, opticalHeader(ros::Time(5)));
  const Eigen::Vector3d point(0.3, -0.2, 2.0);
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> k(info.K.data());
  const Eigen::Vector2d pixel = (k * point).hnormalized();
  // Both are a few roundings of a double.
  EXPECT_LT((pixel - camera.project(point)).norm(), 1e-12);
  EXPECT_EQ(info.D, std::vector<double>(5, 0.0));
}

TEST(Messages, PosesSurviveTheWayThereAndBack) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  pose.translation() = Eigen::Vector3d(1, -2, 3);
  EXPECT_LT((fromPose(toPose(pose)).matrix() - pose.matrix()).norm(), 1e-12);  // rounding
}

TEST(Messages, RefuseWhatIsNoPose) {
  geometry_msgs::Pose pose;
  EXPECT_THROW(fromPose(pose), std::invalid_argument);  // a quaternion of zeros
  pose.orientation.w = 1.0;
  EXPECT_NO_THROW(fromPose(pose));
  pose.position.y = std::numeric_limits<double>::infinity();
  EXPECT_THROW(fromPose(pose), std::invalid_argument);
}

TEST(Options, WithoutParametersAreTheDefaultsOfTheBuiltInWorld) {
  const RenderNodeOptions options = readRenderNodeOptions(ParameterReader(XmlRpc::XmlRpcValue(), "/render"));
  EXPECT_EQ(options.world, "race_track");
  EXPECT_EQ(options.renderOptions().camera.width, 640);
  EXPECT_FALSE(options.pacing.start_stamp_s.has_value());
  EXPECT_EQ(options.exposure.mode, image::ExposureMode::kAuto);
}

TEST(Durations, ReadAsPeopleSayThem) {
  EXPECT_EQ(printedDuration(59.4), "59 s");
  EXPECT_EQ(printedDuration(74.0), "1 min 14 s");
  EXPECT_EQ(printedDuration(3660.0), "1 h 1 min");
}

TEST(Stopwatch, CountsEachCallOfAStage) {
  Stopwatch stopwatch;
  EXPECT_EQ(stopwatch.measure("light", "noon", [] { return 7; }), 7);
  stopwatch.measure("light", "noon", [] {});
  stopwatch.measure("light", "night", [] {});
  ASSERT_EQ(stopwatch.entries().size(), 2u);
  EXPECT_EQ(stopwatch.entries()[0].count, 2);
  EXPECT_EQ(stopwatch.entries()[1].what, "night");
}

}  // namespace
}  // namespace sunlit::ros_interface
