#include "sunlit/evaluate/localise/observations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/core.hpp>

#include "support/message_of.h"
#include "support/temporary_folder.h"

namespace sunlit::evaluate {
namespace {

/// Of two features, the place of the second unknown; descriptors that bytes can hold, or not.
Observation observation(float scale) {
  Observation made;
  made.camera = {640, 480, 554.25, 554.25, 319.5, 239.5};
  made.map_from_optical =
      Eigen::Translation3d(1.5, -2.0, 1e-17) * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ());
  made.features.key_points = {cv::KeyPoint(1.25F, 2.5F, 7.0F, -1.0F, 0.5F), cv::KeyPoint(639.0F, 0.1F, 3.0F)};
  made.features.descriptors = (cv::Mat_<float>(2, 3) << 0, 255, 3, 7, 8, 9) * scale;
  made.points = {{1, 2, 3}, Eigen::Vector3d::Constant(std::nan(""))};
  return made;
}

void expectSame(const Observation& a, const Observation& b) {
  EXPECT_EQ(a.camera.width, b.camera.width);
  EXPECT_EQ(a.camera.cy, b.camera.cy);
  EXPECT_EQ(a.map_from_optical.matrix(), b.map_from_optical.matrix());
  ASSERT_EQ(a.features.key_points.size(), b.features.key_points.size());
  for (std::size_t i = 0; i < a.features.key_points.size(); ++i) {
    EXPECT_EQ(a.features.key_points[i].pt, b.features.key_points[i].pt);
    EXPECT_EQ(a.features.key_points[i].response, b.features.key_points[i].response);
  }
  ASSERT_EQ(a.features.descriptors.type(), b.features.descriptors.type());
  EXPECT_EQ(cv::norm(a.features.descriptors, b.features.descriptors, cv::NORM_INF), 0.0);
  ASSERT_EQ(a.points.size(), b.points.size());
  EXPECT_EQ(a.points[0], b.points[0]);
  EXPECT_TRUE(b.points[1].array().isNaN().all());
}

TEST(ObservationFile, GivesBackWhatWasAddedToTheBit) {
  const TemporaryFolder folder;
  const std::string path = folder.file("observations");
  {
    ObservationFile file(path);
    file.add({"h04", "sift", 3, 500}, observation(1.0F));
    file.add({"h12", "rootsift", 4, 600}, observation(0.3F));
    file.add({"h12", "orb", 4, 600}, {});
  }
  const ObservationFile file(path);
  EXPECT_EQ(file.torn(), 0u);
  const std::vector<ObservationKey> keys = file.keys();
  ASSERT_EQ(keys.size(), 3u);
  EXPECT_EQ(keys[0].stream, "h04");
  EXPECT_EQ(keys[1].detector, "rootsift");
  EXPECT_EQ(keys[1].pose, 4);
  EXPECT_EQ(keys[1].stamp_ns, 600);
  EXPECT_TRUE(file.holds("h12", "orb", 4));
  EXPECT_FALSE(file.holds("h04", "orb", 4) || file.holds("h12", "sift", 4) || file.holds("h12", "orb", 3));
  expectSame(observation(1.0F), file.read(0));
  expectSame(observation(0.3F), file.read(1));
  EXPECT_TRUE(file.read(2).features.descriptors.empty());
}

TEST(ObservationFile, TellsTheHeadWithoutTheRest) {
  const TemporaryFolder folder;
  const std::string path = folder.file("observations");
  Observation large = observation(1.0F);
  large.features.key_points.resize(3000);
  large.features.descriptors = cv::Mat::ones(3000, 3, CV_32F);
  large.points.resize(3000);
  large.ev100 = -1.25;
  {
    ObservationFile file(path);
    file.add({"h04", "sift", 3, 500}, large);
    file.add({"h12", "orb", 4, 600}, {});
  }
  const ObservationFile file(path, ObservationUse::kRead);
  EXPECT_EQ(file.head(0).map_from_optical.matrix(), large.map_from_optical.matrix());
  EXPECT_EQ(file.head(0).camera.fx, large.camera.fx);
  EXPECT_EQ(file.head(0).ev100, -1.25);
  EXPECT_EQ(file.read(0).ev100, -1.25);
  EXPECT_TRUE(std::isnan(file.head(1).ev100));
}

TEST(ObservationFile, WhatIsOnlyReadStaysAsItIs) {
  const TemporaryFolder folder;
  const std::string path = folder.file("observations");
  EXPECT_NE(messageOf<std::runtime_error>([&] {
              ObservationFile(path, ObservationUse::kRead);
            }).find("cannot be opened"),
            std::string::npos);
  { ObservationFile(path).add({"h04", "sift", 3, 500}, observation(1.0F)); }
  const std::string torn = contentOf(path) + "torn";
  std::ofstream(path, std::ios::binary) << torn;
  EXPECT_NE(messageOf<std::runtime_error>([&] {
              ObservationFile(path, ObservationUse::kRead);
            }).find("holds a record that is cut off"),
            std::string::npos);
  EXPECT_EQ(contentOf(path), torn);
}

TEST(ObservationFile, IsWholeWhereverItWasTorn) {
  const TemporaryFolder folder;
  const std::string path = folder.file("observations");
  {
    ObservationFile file(path);
    file.add({"h04", "sift", 3, 500}, observation(1.0F));
  }
  const auto first = std::filesystem::file_size(path);
  EXPECT_EQ(ObservationFile(path).bytes(), first);
  {
    ObservationFile file(path);
    file.add({"h04", "sift", 4, 600}, observation(1.0F));
  }
  const std::string whole = contentOf(path);
  for (auto size = first; size < whole.size(); ++size) {
    std::ofstream(path, std::ios::binary) << whole.substr(0, size);
    ObservationFile file(path);
    ASSERT_EQ(file.keys().size(), 1u);
    EXPECT_EQ(file.torn(), size - first);
    file.add({"h04", "orb", 5, 700}, observation(0.5F));
    expectSame(observation(0.5F), file.read(1));
    ASSERT_EQ(ObservationFile(path).keys().size(), 2u);
  }
}

TEST(ObservationFile, RefusesAnotherFile) {
  const TemporaryFolder folder;
  const std::string path = folder.file("notes.txt");
  std::ofstream(path) << "pose,stamp,a,b,difference,value,features_a";
  const std::string message = messageOf<std::runtime_error>([&] { ObservationFile{path}; });
  EXPECT_NE(message.find(path), std::string::npos);
  EXPECT_NE(message.find("is not a file of observations"), std::string::npos);
  EXPECT_EQ(contentOf(path).substr(0, 4), "pose") << "what is not ours stays";
  EXPECT_NE(messageOf<std::runtime_error>([&] {
              ObservationFile{folder.file("no/such/folder")};
            }).find("cannot be opened"),
            std::string::npos);
}

// A row count of −1, and one beyond all memory, where descriptors begin.
TEST(ObservationFile, RefusesARecordWhosePartsDoNotFit) {
  const TemporaryFolder folder;
  const std::string path = folder.file("observations");
  {
    ObservationFile file(path);
    file.add({"h04", "sift", 3, 500}, observation(1.0F));
  }
  const std::string good = contentOf(path);
  const std::size_t rows_at =
      good.size() - 6 - 2 * sizeof(std::int32_t);  // before 2 × 3 bytes, and their columns
  for (const std::int32_t rows : {-1, 1, 3, 0x7FFFFFFF}) {
    std::string wrong = good;
    wrong.replace(rows_at, sizeof(rows), reinterpret_cast<const char*>(&rows), sizeof(rows));
    setContent(path, wrong);
    EXPECT_EQ(messageOf<std::runtime_error>([&] { ObservationFile(path).read(0); }),
              path + ": holds a record whose numbers of features do not fit")
        << rows;
  }
}

}  // namespace
}  // namespace sunlit::evaluate
