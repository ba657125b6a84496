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

}  // namespace
}  // namespace sunlit::evaluate
