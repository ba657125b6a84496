// The parts of the render node that need no master.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

#include "ros/render/camera_output.h"
#include "ros/render/options.h"
#include "ros/render/path_source.h"
#include "ros/render/robot_places.h"
#include "ros/render/run_files.h"
#include "ros/render/run_log.h"
#include "ros/steady.h"
#include "sunlit/studio/picture_maker.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace sunlit::ros_interface {
namespace {

/// A robot with a camera half a metre before its base and one metre above it.
scene::Robot robotWithCamera(const std::string& link, const std::string& rpy) {
  const std::string body = "<visual><geometry><box size='1 1 1'/></geometry></visual>";
  return scene::parseUrdf("<robot name='r'><link name='base_link'>" + body + "</link><link name='" + link +
                              "'/><joint name='j' type='fixed'><parent link='base_link'/><child link='" +
                              link + "'/><origin xyz='0.5 0 1' rpy='" + rpy + "'/></joint></robot>",
                          "here", {});
}

TEST(CameraYaw, IsThatOfTheLinkThatCarriesTheCamera) {
  const auto yawOf = [](const std::string& link, const std::string& rpy) {
    RobotOptions options;
    options.camera_link = link;
    return cameraYaw(robotWithCamera(link, rpy), options, {}).deg();
  };
  constexpr double kExact = 1e-6;  // the numbers below have ten digits
  EXPECT_EQ(yawOf("eye", "0 0 0"), 0.0);
  EXPECT_NEAR(yawOf("eye", "0 0 1.5707963268"), 90.0, kExact);
  EXPECT_NEAR(std::abs(yawOf("eye", "0 0 3.1415926536")), 180.0, kExact);
  EXPECT_NEAR(yawOf("eye", "0.1 0.3 -0.7853981634"), -45.0, kExact);  // level or not
  EXPECT_EQ(yawOf("eye", "0 1.5707963268 0.5"), 0.0);                 // straight down: nowhere
  EXPECT_EQ(yawOf("eye_optical_frame", "-1.5707963268 0 -1.5707963268"), 0.0);
  EXPECT_NEAR(yawOf("eye_optical_frame", "-1.5707963268 0 0"), 90.0, kExact);
}

TEST(CameraYaw, IsNoneWhereNoLinkCarriesTheCamera) {
  const scene::Robot robot = robotWithCamera("camera_link", "0 0 1");
  RobotOptions options;
  EXPECT_NEAR(cameraYaw(robot, options, {}).rad(), 1.0, 1e-9);  // auto
  options.camera_in_base = Eigen::Vector3d(0.0, 0.0, 1.0);
  EXPECT_EQ(cameraYaw(robot, options, {}).rad(), 0.0);
  options.camera_in_base.reset();
  EXPECT_EQ(cameraYaw(robotWithCamera("eye", "0 0 1"), options, {}).rad(), 0.0);
}

TEST(RobotPlaces, StandWithTheCameraOnItsLinkHoweverThatIsTurned) {
  for (const char* rpy : {"0 0 0", "0 0 2.5", "0 0 3.1415926536"}) {
    const scene::Robot robot = robotWithCamera("camera_link", rpy);
    const RobotPlaces places(robot, {}, {}, 1.0);
    Eigen::Isometry3d map_from_camera = Eigen::Isometry3d::Identity();
    map_from_camera.translate(Eigen::Vector3d(3.0, -2.0, 1.0));
    map_from_camera.rotate(Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()));
    const render::BodyPlaces links = places.onPath(map_from_camera, {});
    EXPECT_TRUE(links[1].isApprox(map_from_camera, 1e-9)) << rpy;
  }
}

TEST(RobotPlaces, WaitForALinkThatOnlyLights) {
  scene::Robot robot = robotWithCamera("headlight", "0 0 0");
  RobotOptions options;
  options.joints_by_tf = true;
  const tf2_ros::Buffer tf;  // which knows no link
  EXPECT_TRUE(RobotPlaces(robot, options, {}, std::nullopt).knowsJoints(tf)) << "nothing of it is seen";
  robot.links[1].lamps.emplace_back();
  RobotPlaces places(robot, options, {}, std::nullopt);
  EXPECT_FALSE(places.knowsJoints(tf));
  EXPECT_NE(places.waitsFor().find("headlight"), std::string::npos) << places.waitsFor();
}

TEST(RobotPlaces, LackALinkInThosePosesInWhichItsTransformDoesNotComeOrIsOld) {
  scene::Robot robot = robotWithCamera("headlight", "0 0 0");
  robot.links[1].lamps.emplace_back();
  RobotOptions options;
  options.joints_by_tf = true;
  options.tf_patience_s = 0.0;
  RobotPlaces places(robot, options, {}, 1.0);
  const FoundTransform first{Eigen::Isometry3d::Identity(), ros::Time(1)};
  const auto lacks = [&](const std::optional<FoundTransform>& headlight) {
    places.count({std::nullopt, headlight});
    return places.lacksLinks();
  };
  EXPECT_FALSE(places.lacksLinks());
  EXPECT_TRUE(lacks(std::nullopt));
  EXPECT_FALSE(lacks(first));
  EXPECT_TRUE(lacks(first));  // as a moment ago
  EXPECT_FALSE(lacks(FoundTransform{first.parent_from_child, ros::Time(2)}));
  EXPECT_NE(places.missingLinks().find("headlight in 1 of 4 poses; "), std::string::npos)
      << places.missingLinks();
}

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

TEST(OutgoingPicture, MakesEachMessageOnce) {
  image::Rgb8Image picture(3, 2);
  picture.data[4] = 200;
  std_msgs::Header header;
  header.frame_id = "camera_optical_frame";
  OutgoingPicture outgoing(picture, header);
  EXPECT_EQ(outgoing.png(), outgoing.png());
  EXPECT_EQ(outgoing.raw(), outgoing.raw());
  EXPECT_EQ(outgoing.raw()->data, picture.data);
  EXPECT_EQ(outgoing.raw()->header.frame_id, header.frame_id);
  EXPECT_EQ(outgoing.png()->header.frame_id, header.frame_id);
  EXPECT_EQ(outgoing.png()->format, "rgb8; png compressed bgr8");
}

TEST(Options, WithoutParametersAreTheDefaultsOfTheBuiltInWorld) {
  const RenderNodeOptions options = readRenderNodeOptions(ParameterReader(XmlRpc::XmlRpcValue(), "/render"));
  EXPECT_EQ(options.world.name, "race_track");
  EXPECT_EQ(options.studioOptions().render.camera.width, 640);
  EXPECT_FALSE(options.pacing.start_stamp_s.has_value());
  EXPECT_EQ(options.chain.exposure.mode, image::ExposureMode::kAuto);
}

class Waiting : public testing::Test {
 protected:
  /// Whether it is worth a word, so many seconds later.
  bool after(double seconds, const Wait& wait) {
    now_s_ += seconds;
    return log_.report(wait);
  }
  double now_s_ = 100.0;
  WaitLog log_{[this] { return now_s_; }};
};

TEST_F(Waiting, ForTheSameIsWorthAWordHoweverItsWordsChange) {
  EXPECT_FALSE(after(0.0, {"a sky, which stands at 0", "a sky"}));
  EXPECT_FALSE(after(1.9, {"a sky, which stands at 1.9", "a sky"}));
  EXPECT_TRUE(after(0.1, {"a sky, which stands at 2", "a sky"}));
  EXPECT_TRUE(after(0.1, {"a sky, which stands at 2.1", "a sky"}));
}

TEST_F(Waiting, ForSomethingElseOrForNothingBeginsAnew) {
  after(0.0, std::string("progress, which stands at 3"));
  EXPECT_FALSE(after(3.0, std::string("progress, which stands at 4")));
  EXPECT_TRUE(after(2.0, std::string("progress, which stands at 4")));
  EXPECT_FALSE(after(5.0, {}));
  EXPECT_FALSE(after(0.0, std::string("progress, which stands at 4")));
}

TEST(Throttle, GoesByTheSteadyClockAndForEachByItself) {
  Throttle throttle(5.0);
  const ros::SteadyTime begin(100, 0);
  const auto after = [&](double seconds) { return begin + ros::WallDuration(seconds); };
  EXPECT_TRUE(throttle.isTime("a sun", begin));
  EXPECT_TRUE(throttle.isTime("a moon", after(1.0)));
  EXPECT_FALSE(throttle.isTime("a sun", after(4.9)));
  EXPECT_TRUE(throttle.isTime("a sun", after(5.0)));
  EXPECT_FALSE(throttle.isTime("a moon", after(5.5)));
}

TEST(ClockWatch, TellsForHowLongTimeHasStoodStill) {
  ClockWatch watch;
  EXPECT_EQ(watch.standsFor(ros::Time(7), ros::SteadyTime(100, 0)), 0.0);
  EXPECT_EQ(watch.standsFor(ros::Time(7), ros::SteadyTime(102, 0)), 2.0);
  EXPECT_EQ(watch.standsFor(ros::Time(8), ros::SteadyTime(103, 0)), 0.0);
  EXPECT_EQ(watch.standsFor(ros::Time(7), ros::SteadyTime(104, 0)), 0.0);  // jumped back
  EXPECT_EQ(watch.standsFor(ros::Time(7), ros::SteadyTime(105, 0)), 1.0);
}

class RunFolder : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "sunlit_timing_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  /// What is in the folder after a run of `count` poses of 2 s each.
  std::string after(int count, bool goes_on) {
    double now_s = 0.0;
    studio::Stopwatch stopwatch([&now_s] { return now_s; });
    const RunFiles files(folder_, goes_on);
    for (int i = 0; i < count; ++i) {
      stopwatch.measure("geometry", "pose", [&] { now_s += 2.0; });
      files.writeTiming(stopwatch);  // each time the whole run so far
    }
    std::ifstream file(folder_ + "/timing.csv");
    return {std::istreambuf_iterator<char>(file), {}};
  }
  std::string folder_;
};

TEST_F(RunFolder, CountsTheTimesOfAllRunsThatItTookOnceEach) {
  EXPECT_EQ(after(3, true), "stage,what,count,seconds\ngeometry,pose,3,6\n");  // nothing to go on with
  EXPECT_EQ(after(4, true), "stage,what,count,seconds\ngeometry,pose,7,14\n");
  EXPECT_EQ(after(0, true), "stage,what,count,seconds\ngeometry,pose,7,14\n");
  EXPECT_EQ(after(1, false), "stage,what,count,seconds\ngeometry,pose,1,2\n");  // from the beginning
}

TEST_F(RunFolder, StaysAsItIsUntilTheRunWritesToIt) {
  const std::string left = after(2, false);
  EXPECT_EQ(after(0, false), left);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);
}

TEST_F(RunFolder, WithValuesOfTheEvaluatorIsGoneOnWithWhateverTheOptionsSay) {
  RunFiles(folder_, false).keepInputs({"0123", "4567", "89", ""});
  after(2, false);
  std::ofstream(folder_ + "/frames.csv") << "heading\n";
  EXPECT_EQ(after(1, false), "stage,what,count,seconds\ngeometry,pose,1,2\n");
  std::ofstream(folder_ + "/frames.csv", std::ios::app) << "0,1000.0,a,b,orb,0.5,1,1,1,0\n";
  EXPECT_EQ(after(1, false), "stage,what,count,seconds\ngeometry,pose,2,4\n");
  EXPECT_EQ(messageOf<std::runtime_error>([&] {
              RunFiles(folder_, false).keepInputs({"0123", "4567", "89", ""});
            }),
            "");
  EXPECT_NE(messageOf<std::runtime_error>([&] {
              RunFiles(folder_, false).keepInputs({"0124", "4567", "89", ""});
            }),
            "");
}

TEST_F(RunFolder, IsOnlyGoneOnWithFromTheSameInputs) {
  const auto keep = [&](bool goes_on, const RunInputs& inputs) {
    return messageOf<std::runtime_error>([&] { RunFiles(folder_, goes_on).keepInputs(inputs); });
  };
  EXPECT_EQ(keep(false, {"0123", "4567", "89", ""}), "");
  EXPECT_EQ(keep(true, {"0123", "4567", "89", ""}), "");
  EXPECT_NE(keep(true, {"0123", "4567", "8a", ""}).find("camera: '8a'"), std::string::npos);
  EXPECT_NE(keep(true, {"0123", "4567", "89", "ef"}).find("robot: 'ef'"), std::string::npos);
  for (const auto& [inputs, line] : std::map<std::pair<std::string, std::string>, std::string>{
           {{"0124", "4567"}, "world: '0124'"}, {{"0123", "4568"}, "path: '4568'"}}) {
    const std::string error = keep(true, {inputs.first, inputs.second, "89", ""});
    EXPECT_NE(error.find(folder_ + "/inputs.yaml: "), std::string::npos) << error;
    EXPECT_NE(error.find(line), std::string::npos) << error;
  }
  EXPECT_EQ(keep(true, {"0123", "4567", "89", ""}), "");  // refused, and nothing lost
  EXPECT_EQ(keep(false, {"89", "ab", "cd", ""}), "");     // begun anew
  EXPECT_NE(keep(true, {"0123", "4567", "89", ""}), "");
  std::string text = contentOf(folder_ + "/inputs.yaml");
  const std::string ours = "sunlit: '" + studio::pictureMaker();
  ASSERT_EQ(text.compare(0, ours.size(), ours), 0) << text;
  std::ofstream(folder_ + "/inputs.yaml") << text.insert(ours.size(), "0");  // other pictures
  const std::string of_another_version = keep(true, {"89", "ab", "cd", ""});
  EXPECT_NE(of_another_version.find(ours), std::string::npos) << of_another_version;
  EXPECT_NE(of_another_version.find("`rosrun sunlit report`"), std::string::npos) << of_another_version;
  std::filesystem::remove(folder_ + "/inputs.yaml");
  const std::string of_nobody_knows_what = keep(true, {"89", "ab", "cd", ""});
  EXPECT_NE(of_nobody_knows_what.find("inputs.yaml: is not there"), std::string::npos)
      << of_nobody_knows_what;
}

TEST_F(RunFolder, NamesTheLineOfATimeSheetThatItCannotRead) {
  for (const char* bad : {"stage\n", "stage,what,count,seconds\ngeometry,pose,x,1\n",
                          "stage,what,count,seconds\ngeometry,pose,1,1,1\n",
                          "stage,what,count,seconds\ngeometry,pose,1,-1\n"}) {
    std::ofstream(folder_ + "/timing.csv", std::ios::trunc) << bad;
    const std::string line = std::string(bad) == "stage\n" ? ":1:" : ":2:";
    const std::string error = messageOf<std::runtime_error>([&] { RunFiles(folder_, true); });
    EXPECT_NE(error.find(folder_ + "/timing.csv" + line), std::string::npos) << bad << error;
  }
}

}  // namespace
}  // namespace sunlit::ros_interface
