#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "sunlit/evaluate/files/frames_file.h"
#include "support/message_of.h"
#include "unit/evaluate/run/small_evaluation.h"

namespace sunlit::evaluate {
namespace {

EvaluationOptions allPictures(const TemporaryFolder& folder) {
  EvaluationOptions options = optionsFor(folder);
  options.images = KeptImages::kAll;
  return options;
}

std::string messageOfRun(const EvaluationOptions& options) {
  return messageOf<std::exception>([&] {
    Evaluation evaluation(options, {});
    for (int pose = 0; pose < 4; ++pose) feedPose(evaluation, pose);
    evaluation.waitForRoom(0);
  });
}

TEST(Pictures, OfAPoseAreThereBeforeItsRows) {
  const TemporaryFolder folder;
  int checked = 0;
  EvaluationCallbacks callbacks;
  callbacks.pair_done = [&](const PairRecord& record, const cv::Mat&, const cv::Mat&) {
    for (const char* stream : {"h04", "h12", "h20"}) {
      const std::string name =
          "out/images/" + std::string(stream) + "/00000" + std::to_string(record.pose) + ".png";
      EXPECT_TRUE(std::filesystem::exists(folder.file(name))) << name;
    }
    ++checked;
  };
  Evaluation evaluation(allPictures(folder), callbacks);
  for (int pose = 0; pose < 8; ++pose) feedPose(evaluation, pose);
  EXPECT_TRUE(evaluation.finish().isWhole());
  EXPECT_EQ(checked, 3 * 8);
}

TEST(Pictures, ThatCannotBeWrittenStopTheRunBeforeItsRows) {
  const TemporaryFolder folder;
  const EvaluationOptions options = allPictures(folder);
  std::filesystem::create_directories(folder.file("out/images"));
  setContent(folder.file("out/images/h20"), "in the way");
  const std::string message = messageOfRun(options);
  EXPECT_NE(message.find(folder.file("out/images/h20")), std::string::npos) << message;
  EXPECT_EQ(contentOf(folder.file("out/frames.csv")), framesHeader() + "\n");

  // With room for them, the same folder is taken up again and lacks nothing.
  std::filesystem::remove(folder.file("out/images/h20"));
  EXPECT_EQ(messageOfRun(options), "");
  for (const char* stream : {"h04", "h12", "h20"}) {
    EXPECT_TRUE(std::filesystem::exists(folder.file("out/images/" + std::string(stream) + "/000003.png")))
        << stream;
  }
}

// Of a pose of which nothing is compared the first image is all that is waited for.
TEST(Pictures, OfPosesOfWhichNothingIsComparedAreKeptOfAllStreams) {
  const TemporaryFolder folder;
  EvaluationOptions options = allPictures(folder);
  options.frame_rate = 10.0;
  options.stamp_start_ns = stampOf(0);
  options.poses.count = 4;
  options.pairs = {{"h04", "h12", 2}, {"h04", "h20", 2}};
  Evaluation evaluation(options, {});
  for (int pose = 0; pose < 6; ++pose) feedPose(evaluation, pose);
  evaluation.waitForRoom(0);
  EXPECT_EQ(evaluation.counts().queued_poses, 0u);
  EXPECT_EQ(evaluation.counts().bytes, 0u);
  const Outcome outcome = evaluation.finish();
  for (const StreamCounts& stream : outcome.counts.streams) {
    EXPECT_EQ(stream.late, 0u);
    EXPECT_EQ(stream.unexpected, 2u);
  }
  for (const std::string stream : {"h04", "h12", "h20"}) {
    for (const char pose : {'0', '1', '2', '3', '4', '5'}) {
      EXPECT_EQ(std::filesystem::exists(folder.file("out/images/" + stream + "/00000" + pose + ".png")),
                pose < '4')
          << stream << " " << pose;
    }
  }
}

}  // namespace
}  // namespace sunlit::evaluate
