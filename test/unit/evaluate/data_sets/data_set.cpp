// Data sets, read back by what reads other people's.
#include "sunlit/evaluate/data_sets/data_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "sunlit/evaluate/trajectory/trajectory_evaluation.h"
#include "sunlit/image/files.h"
#include "sunlit/quantity/frames.h"
#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace sunlit::evaluate {
namespace {

namespace fs = std::filesystem;

constexpr DataSetFormat kAll[] = {DataSetFormat::kTum, DataSetFormat::kEuroc, DataSetFormat::kColmap};

/// A drive along a helix, so that no axis is like another.
std::vector<DataSetFrame> helix(int n) {
  std::vector<DataSetFrame> frames;
  for (int i = 0; i < n; ++i) {
    const double angle = 0.4 * i;
    DataSetFrame frame{10 + 2 * i, 1000000000000 + i * 33333333, Eigen::Isometry3d::Identity()};
    frame.map_from_camera.translation() =
        Eigen::Vector3d(20 * std::cos(angle), 20 * std::sin(angle), 0.1 * i);
    frame.map_from_camera.linear() = (Eigen::AngleAxisd(angle + 1.5, Eigen::Vector3d::UnitZ()) *
                                      Eigen::AngleAxisd(0.05 * i, Eigen::Vector3d::UnitX()))
                                         .toRotationMatrix();
    frames.push_back(frame);
  }
  return frames;
}

DataSetOptions optionsOf(int width, int height) {
  DataSetOptions options;
  options.camera = {width, height, 30.0, 31.0, 0.5 * (width - 1), 0.5 * (height - 1)};
  return options;
}

image::Rgb8Image colours(int width, int height) {
  image::Rgb8Image picture(width, height);
  for (std::size_t i = 0; i < picture.data.size(); ++i) picture.data[i] = static_cast<std::uint8_t>(i * 37);
  return picture;
}

class DataSets : public ::testing::Test {
 protected:
  DataSetFolder folder(DataSetFormat format, const DataSetOptions& options) const {
    return DataSetFolder(folder_.path(), format, options);
  }
  std::string file(const std::string& name) const { return folder_.file(name); }

  const TemporaryFolder folder_;
};

void expectTrajectory(const Trajectory& read, const std::vector<DataSetFrame>& frames,
                      const Eigen::Isometry3d& link_from_body) {
  ASSERT_EQ(read.size(), frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Eigen::Isometry3d expected = frames[i].map_from_camera * link_from_body;
    EXPECT_EQ(read[i].stamp_ns, frames[i].stamp_ns);
    // Half of the last digit, in each of three axes; of the quaternion's, twice as an angle.
    EXPECT_LE((read[i].position - expected.translation()).norm(), 1e-9);
    EXPECT_LE(read[i].orientation.angularDistance(Eigen::Quaterniond(expected.linear())), 5e-12);
  }
}

TEST_F(DataSets, TruthOfTumIsOfTheOpticalFrame) {
  folder(DataSetFormat::kTum, optionsOf(16, 16)).finish(helix(20));
  expectTrajectory(readTrajectory(file("groundtruth.txt")), helix(20), linkFromOptical());
}

/// How many lines of comment stand before the first other one, of which there are as many as `data`.
int commentsBefore(const std::string& text, int data) {
  std::istringstream lines(text);
  int comments = 0, others = 0;
  for (std::string line; std::getline(lines, line);) {
    const bool is_comment = line[0] == '#';
    EXPECT_FALSE(is_comment && others > 0) << line;
    (is_comment ? comments : others) += 1;
  }
  EXPECT_EQ(others, data);
  return comments;
}

// ORB-SLAM's mono_tum skips three lines, whatever they are.
TEST_F(DataSets, ThreeLinesStandBeforeTheDataOfTum) {
  folder(DataSetFormat::kTum, optionsOf(16, 16)).finish(helix(20));
  for (const char* name : {"rgb.txt", "depth.txt", "groundtruth.txt"})
    EXPECT_EQ(commentsBefore(contentOf(file(name)), 20), 3) << name;
  EXPECT_EQ(commentsBefore(contentOf(file("associations.txt")), 20), 0);
}

TEST_F(DataSets, TruthOfEurocIsOfTheLink) {
  folder(DataSetFormat::kEuroc, optionsOf(16, 16)).finish(helix(20));
  const Trajectory truth = readTrajectory(file("mav0/state_groundtruth_estimate0/data.csv"));
  expectTrajectory(truth, helix(20), Eigen::Isometry3d::Identity());
}

TEST_F(DataSets, TruthAgainstItselfHasNoError) {
  folder(DataSetFormat::kTum, optionsOf(16, 16)).finish(helix(20));
  const Trajectory truth = readTrajectory(file("groundtruth.txt"));
  for (const TrajectoryRow& row : evaluateTrajectory(truth, truth, {}).rows) {
    EXPECT_GT(row.statistics.n, 0u) << row.metric;
    // Angles come from products of quaternions of unit length, by rounding 1e-15 off: √ of that, in degrees.
    EXPECT_LE(row.statistics.max, row.unit == "m" ? 1e-12 : 1e-5) << row.metric;
  }
}

TEST_F(DataSets, VelocityOfEurocIsThatBetweenTheNeighbours) {
  std::vector<DataSetFrame> frames = helix(3);
  for (int i = 0; i < 3; ++i) {
    frames[i].stamp_ns = 1000000000000 + i * 500000000LL;
    frames[i].map_from_camera.translation() = Eigen::Vector3d(1.0 * i * i, 2.0 * i, -3.0);
  }
  folder(DataSetFormat::kEuroc, optionsOf(16, 16)).finish(frames);
  std::istringstream lines(contentOf(file("mav0/state_groundtruth_estimate0/data.csv")));
  std::string header, row;
  std::getline(lines, header);
  // (0, 1, 4) m in x: 1 m in 0.5 s, 4 m in 1 s, 3 m in 0.5 s.
  for (const std::string velocity :
       {"2.000000000,4.000000000,0.000000000", "4.000000000,4.000000000,0.000000000",
        "6.000000000,4.000000000,0.000000000"}) {
    ASSERT_TRUE(std::getline(lines, row));
    EXPECT_NE(row.find(',' + velocity + ",0.000000000,"), std::string::npos) << row;
    EXPECT_EQ(std::count(row.begin(), row.end(), ','), 16);
  }
  EXPECT_EQ(std::count(header.begin(), header.end(), ','), 16);
}

TEST_F(DataSets, ASinglePoseStandsStill) {
  folder(DataSetFormat::kEuroc, optionsOf(16, 16)).finish(helix(1));
  EXPECT_EQ(readTrajectory(file("mav0/state_groundtruth_estimate0/data.csv")).size(), 1u);
  EXPECT_EQ(contentOf(file("mav0/state_groundtruth_estimate0/data.csv")).find("nan"), std::string::npos);
}

TEST_F(DataSets, DepthHasRoomUpToTheLastStep) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  image::DepthImage depth(16, 16);
  for (float& value : depth.data) value = nan;
  depth.data[0] = 1.0f;      // 5000 steps
  depth.data[1] = 13.107f;   // 65535
  depth.data[2] = 13.1072f;  // 65536: no room
  depth.data[3] = 0.00011f;  // 0.55: rounds to 1
  depth.data[4] = 0.00009f;  // 0.45: rounds to 0, which means "none"
  depth.data[5] = 20000.0f;
  const DataSetFrame frame = helix(1)[0];
  const DataSetFolder tum = folder(DataSetFormat::kTum, optionsOf(16, 16));
  const DepthRoom room = tum.write(frame, colours(16, 16), depth);
  EXPECT_EQ(room.seen, 6u);
  EXPECT_EQ(room.without_room, 3u);
  const image::Grey16Image steps = image::readGrey16Png(file("depth/1000.000000000.png"));
  const std::vector<std::uint16_t> expected{5000, 65535, 0, 1, 0, 0, 0};
  EXPECT_EQ(std::vector<std::uint16_t>(steps.data.begin(), steps.data.begin() + 7), expected);
}

TEST_F(DataSets, DepthOfColmapKeepsEveryBit) {
  image::DepthImage depth(16, 17);
  for (std::size_t i = 0; i < depth.data.size(); ++i) depth.data[i] = 0.1f * static_cast<float>(i + 1);
  depth.data[20] = std::numeric_limits<float>::quiet_NaN();
  const DataSetFolder colmap = folder(DataSetFormat::kColmap, optionsOf(16, 17));
  const DepthRoom room = colmap.write(helix(1)[0], colours(16, 17), depth);
  EXPECT_EQ(room.seen, depth.data.size() - 1);
  EXPECT_EQ(room.without_room, 0u);
  const std::string bytes = contentOf(file("depth/000010.png.bin"));
  const std::string header = "16&17&1&";
  ASSERT_EQ(bytes.size(), header.size() + 4 * depth.data.size());
  EXPECT_EQ(bytes.substr(0, header.size()), header);
  depth.data[20] = 0.0f;
  EXPECT_EQ(std::memcmp(bytes.data() + header.size(), depth.data.data(), 4 * depth.data.size()), 0);
}

TEST_F(DataSets, PicturesAreColouredButThoseOfEurocAreGrey) {
  const image::Rgb8Image picture = colours(16, 16);
  const image::DepthImage depth(16, 16);
  const DataSetFrame frame = helix(1)[0];
  for (const DataSetFormat format : kAll) folder(format, optionsOf(16, 16)).write(frame, picture, depth);
  EXPECT_EQ(image::readPng(file("rgb/1000.000000000.png")).data, picture.data);
  EXPECT_EQ(image::readPng(file("images/000010.png")).data, picture.data);
  const cv::Mat grey = cv::imread(file("mav0/cam0/data/1000000000000.png"), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(grey.type(), CV_8UC1);
  // Luma of Rec. 601, rounded.
  const auto luma = [&](std::size_t i) {
    return std::lround(0.299 * picture.data[3 * i] + 0.587 * picture.data[3 * i + 1] +
                       0.114 * picture.data[3 * i + 2]);
  };
  for (std::size_t i = 0; i < 256; ++i) EXPECT_EQ(grey.data[i], luma(i)) << i;
}

TEST_F(DataSets, SettingsOfOrbSlamAreWhatOpenCvReads) {
  DataSetOptions options = optionsOf(16, 20);
  options.depth_scale = 500.0;
  folder(DataSetFormat::kTum, options).finish(helix(2));
  const cv::FileStorage settings(file("orb_slam.yaml"), cv::FileStorage::READ);
  EXPECT_EQ(settings["Camera.type"].string(), "PinHole");
  // ORB-SLAM3 refuses a whole number where it wants a real one, and the other way round.
  const std::vector<std::pair<const char*, double>> reals = {
      {"Camera.fx", 30.0}, {"Camera.fy", 31.0},      {"Camera.cx", 7.5}, {"Camera.cy", 9.5},
      {"Camera.k1", 0.0},  {"Camera.k2", 0.0},       {"Camera.p1", 0.0}, {"Camera.p2", 0.0},
      {"ThDepth", 40.0},   {"DepthMapFactor", 500.0}};
  for (const auto& [key, value] : reals) {
    ASSERT_TRUE(settings[key].isReal()) << key;
    EXPECT_NEAR(settings[key].real(), value, 1e-9) << key;
  }
  ASSERT_TRUE(settings["Camera.bf"].isReal());
  EXPECT_NEAR(settings["Camera.bf"].real() / 30.0, 0.0773, 1e-4);
  ASSERT_TRUE(settings["Camera.width"].isInt() && settings["Camera.height"].isInt());
  EXPECT_EQ(static_cast<int>(settings["Camera.height"]), 20);
}

TEST_F(DataSets, AFrameIsThereOnlyIfItIsWhole) {
  const DataSetFrame frame = helix(1)[0];
  const std::vector<std::pair<std::string, std::string>> files = {
      {"rgb/1000.000000000.png", "depth/1000.000000000.png"},
      {"mav0/cam0/data/1000000000000.png", "mav0/depth0/data/1000000000000.png"},
      {"images/000010.png", "depth/000010.png.bin"}};
  for (std::size_t i = 0; i < 3; ++i) {
    const DataSetFolder data_set = folder(kAll[i], optionsOf(16, 16));
    EXPECT_FALSE(data_set.has(frame));
    data_set.write(frame, colours(16, 16), image::DepthImage(16, 16));
    EXPECT_TRUE(data_set.has(frame));
    EXPECT_FALSE(folder(kAll[i], optionsOf(17, 16)).has(frame));
    for (const std::string& name : {files[i].first, files[i].second}) {
      const std::string whole = contentOf(file(name));
      setContent(file(name), whole.substr(0, whole.size() / 2));
      EXPECT_FALSE(data_set.has(frame)) << name;
      fs::remove(file(name));
      EXPECT_FALSE(data_set.has(frame)) << name;
      setContent(file(name), whole);
      EXPECT_TRUE(data_set.has(frame)) << name;
    }
  }
}

TEST_F(DataSets, WhatIsNotOfTheCameraIsRefused) {
  const DataSetFolder tum = folder(DataSetFormat::kTum, optionsOf(16, 16));
  const DataSetFrame frame = helix(1)[0];
  for (const auto& [width, height] : {std::pair{15, 16}, {16, 15}, {0, 0}}) {
    EXPECT_NE(
        messageOf([&, w = width, h = height] { tum.write(frame, colours(w, h), image::DepthImage(16, 16)); }),
        "");
    EXPECT_NE(
        messageOf([&, w = width, h = height] { tum.write(frame, colours(16, 16), image::DepthImage(w, h)); }),
        "");
  }
  EXPECT_FALSE(fs::exists(file("rgb")));
  DataSetOptions options = optionsOf(16, 16);
  options.depth_scale = 0.0;
  EXPECT_EQ(messageOf([&] { folder(DataSetFormat::kTum, options); }),
            "depth_scale is 0, but must be from 0.1 to 1000000 1/m");
  options = optionsOf(16, 16);
  options.rate_hz = 0.0;
  EXPECT_EQ(messageOf([&] { folder(DataSetFormat::kTum, options); }), "rate is 0, but must be above 0 Hz");
  options = optionsOf(16, 16);
  options.camera.fx = std::nan("");
  EXPECT_NE(messageOf([&] { folder(DataSetFormat::kTum, options); }).find("fx is nan"), std::string::npos);
}

TEST_F(DataSets, WhereNothingCanBeWrittenTheFileIsNamed) {
  setContent(file("rgb"), "not a folder");
  const DataSetFolder tum = folder(DataSetFormat::kTum, optionsOf(16, 16));
  const std::string said = messageOf<std::runtime_error>(
      [&] { tum.write(helix(1)[0], colours(16, 16), image::DepthImage(16, 16)); });
  EXPECT_EQ(said.compare(0, file("rgb").size(), file("rgb")), 0) << said;
}

}  // namespace
}  // namespace sunlit::evaluate
