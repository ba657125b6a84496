// Poses whose number neither a frame rate nor a capture tells: those of runs that were cut off, too.
#include <gtest/gtest.h>

#include <chrono>

#include "evaluate/run/pose_index.h"
#include "unit/evaluate/run/small_evaluation.h"

namespace sunlit::evaluate {
namespace {

constexpr std::int64_t kPoses = 10;

EvaluationOptions tenPoses(const TemporaryFolder& folder, const std::string& out = "out") {
  EvaluationOptions options = optionsFor(folder);
  options.output_dir = folder.file(out);
  options.poses.count = kPoses;
  options.images = KeptImages::kAll;
  return options;
}

void feedAll(Evaluation& evaluation) {
  for (std::int64_t pose = 0; pose < kPoses; ++pose) feedPose(evaluation, pose);
}

/// The files of a run, which may have been cut off before.
std::vector<std::string> filesOf(const std::string& folder) {
  std::vector<std::string> texts;
  for (const char* name : {"frames.csv", "summary.csv", "problems.csv"})
    texts.push_back(contentOf(folder + "/" + name));
  for (int pose = 0; pose < kPoses; ++pose)
    texts.push_back(contentOf(folder + "/images/h12/00000" + std::to_string(pose) + ".png"));
  return texts;
}

std::vector<std::string> filesOfUndisturbedRun(const TemporaryFolder& folder) {
  Evaluation evaluation(tenPoses(folder, "undisturbed"), {});
  feedAll(evaluation);
  EXPECT_TRUE(evaluation.finish().isWhole());
  return filesOf(folder.file("undisturbed"));
}

TEST(PosesByOrder, KeepTheirNumbersWhereARunWasKilledAndOneBeforeThemWasNotEvaluated) {
  const TemporaryFolder folder;
  {
    Evaluation killed(tenPoses(folder), {});
    for (std::int64_t pose = 0; pose < 4; ++pose) feedPose(killed, pose);
    killed.addImage(0, stampOf(4), picture(4, 0));  // it waits for its partners
    feedPose(killed, 5);
    killed.waitForRoom(0);
  }
  for (const bool is_first : {true, false}) {
    Evaluation evaluation(tenPoses(folder), {});
    EXPECT_EQ(evaluation.isComplete(), !is_first);
    feedAll(evaluation);
    evaluation.waitForRoom(0);
    EXPECT_TRUE(evaluation.isComplete());
    const Outcome outcome = evaluation.finish();
    EXPECT_TRUE(outcome.isWhole());
    EXPECT_EQ(outcome.counts.unexpected_poses, 0u);
    EXPECT_EQ(outcome.counts.pairs[0].resumed, is_first ? 5u : 10u);
    EXPECT_EQ(filesOf(folder.file("out")), filesOfUndisturbedRun(folder));
  }
}

TEST(PosesByOrder, KeepThePlaceOfOneThatLackedItsPartner) {
  const TemporaryFolder folder;
  {
    Evaluation evaluation(tenPoses(folder), {});
    for (std::int64_t pose = 0; pose < kPoses; ++pose) {
      if (pose == 3) evaluation.addImage(0, stampOf(pose), picture(pose, 0));
      if (pose != 3) feedPose(evaluation, pose);
    }
    EXPECT_FALSE(evaluation.finish().isWhole());
  }
  const std::string frames = contentOf(folder.file("out/frames.csv"));
  EXPECT_TRUE(hasLine(frames, "9,500.900000000,h04,h12,")) << frames;
  Evaluation(tenPoses(folder), {}).finish();  // nothing comes
  EXPECT_EQ(contentOf(folder.file("out/frames.csv")), frames);
  Evaluation evaluation(tenPoses(folder), {});
  feedAll(evaluation);
  EXPECT_TRUE(evaluation.finish().isWhole());
  EXPECT_EQ(filesOf(folder.file("out")), filesOfUndisturbedRun(folder));
}

EvaluationOptions thinned(const TemporaryFolder& folder) {
  EvaluationOptions options = optionsFor(folder);
  options.streams = {"h04", "h12"};
  options.pairs = {{"h04", "h12", 2}};
  return options;
}

// Which are every second is known once all have come, and to whoever takes the run up never.
TEST(PosesByOrder, AreNotThoseOfAPairThatIsThinned) {
  const TemporaryFolder folder;
  Evaluation evaluation(thinned(folder), {});
  for (std::int64_t pose = 0; pose < 4; ++pose) feedPose(evaluation, pose);
  const Outcome outcome = evaluation.finish();
  EXPECT_EQ(outcome.counts.pairs[0].evaluated, 0u);
  EXPECT_EQ(outcome.counts.pairs[0].unplaced, 4u);
  EXPECT_FALSE(outcome.isWhole());
  const std::string problems = contentOf(folder.file("out/problems.csv"));
  EXPECT_TRUE(hasLine(problems,
                      "unplaced,,500.100000000,h04-h12,\"no capture of this stamp says which pose it is, as "
                      "every of a pair needs, or a frame_rate\""))
      << problems;
}

TEST(PosesByOrder, AreNotTakenForThoseOfCapturesThatComeLater) {
  const TemporaryFolder folder;
  Evaluation evaluation(thinned(folder), {});
  for (std::int64_t pose = 7; pose < 11; ++pose) {
    feedPose(evaluation, pose);
    CaptureRecord capture;
    capture.pose = pose;
    capture.stamp_ns = stampOf(pose);
    evaluation.addCapture(0, capture);
  }
  EXPECT_TRUE(evaluation.finish().isWhole());
  const std::string frames = contentOf(folder.file("out/frames.csv"));
  for (const char* even : {"8,", "10,"}) EXPECT_TRUE(hasLine(frames, even)) << frames;
  for (const char* odd : {"7,", "9,"}) EXPECT_FALSE(hasLine(frames, odd)) << frames;
}

// Hours of images: to count one by one up to each takes half a minute.
TEST(PosesByOrder, AreRankedOnce) {
  constexpr std::int64_t kStamps = 100000;
  PoseIndex poses(0.0, 0, {}, true);
  for (std::int64_t stamp = kStamps; stamp-- > 0;) poses.of(stamp);
  poses.rank();
  const auto before = std::chrono::steady_clock::now();
  for (std::int64_t stamp = 0; stamp < kStamps; ++stamp) ASSERT_EQ(poses.settled(stamp, -1), stamp);
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(2));
}

}  // namespace
}  // namespace sunlit::evaluate
