// A folder in which an earlier run left something.
#include <gtest/gtest.h>

#include <tuple>

#include "support/message_of.h"
#include "unit/evaluate/run/small_evaluation.h"

namespace sunlit::evaluate {
namespace {

/// Of poses that their stamps tell, as in an experiment.
EvaluationOptions experimentOf(const TemporaryFolder& folder, std::size_t poses) {
  EvaluationOptions options = optionsFor(folder);
  options.frame_rate = 10.0;
  options.stamp_start_ns = stampOf(0);
  options.poses.count = poses;
  return options;
}

/// Leaves what a run that is killed has evaluated.
void evaluate(const EvaluationOptions& options, const std::vector<std::int64_t>& poses) {
  Evaluation evaluation(options, {});
  for (const std::int64_t pose : poses) feedPose(evaluation, pose);
  evaluation.waitForRoom(0);
}

TEST(TakenUpRun, TellsSendersToGoOnAsFarAsItIsWithoutAHole) {
  const TemporaryFolder folder;
  const EvaluationOptions options = experimentOf(folder, 10);
  evaluate(options, {0, 1, 2, 5, 6, 7, 8});
  std::size_t progress = 0;
  EvaluationCallbacks callbacks;
  callbacks.progress = [&](std::size_t passed) { progress = passed; };
  Evaluation evaluation(options, callbacks);
  EXPECT_EQ(evaluation.counts().completed_poses, 7u);
  EXPECT_EQ(evaluation.counts().passed_poses, 3u);
  for (const auto& [pose, passed] : {std::pair<std::int64_t, std::size_t>{3, 4}, {4, 9}, {9, 10}}) {
    feedPose(evaluation, pose);
    evaluation.waitForRoom(0);
    EXPECT_EQ(progress, passed) << pose;
  }
  EXPECT_TRUE(evaluation.isComplete());
  EXPECT_TRUE(evaluation.finish().isWhole());
}

TEST(TakenUpRun, IsRefusedWhereItsWholePathHasFewerPosesThanWereEvaluated) {
  const TemporaryFolder folder;
  EvaluationOptions options = experimentOf(folder, 9);
  options.is_whole_path = true;
  evaluate(options, {0, 1, 2, 3, 4, 8});
  const std::string run = contentOf(folder.file("out/run.yaml"));
  options.poses.count = 4;
  const auto refusal = [](const EvaluationOptions& asked) {
    return messageOf([&] { Evaluation(asked, {}); });
  };
  EXPECT_EQ(refusal(options), "output_dir " + folder.file("out") +
                                  " holds 6 evaluated poses, and 2 of them are not among the 4 of this path: "
                                  "choose another output_dir, or as many poses as before");
  EXPECT_EQ(contentOf(folder.file("out/run.yaml")), run) << "what is refused changes nothing";
  EvaluationOptions merged = options;
  merged.output_dir = folder.file("merged");
  merged.merge = {folder.file("out")};
  EXPECT_NE(refusal(merged).find(", with what is merged, holds 6"), std::string::npos) << refusal(merged);
  options.poses.count = 9;
  EXPECT_EQ(refusal(options), "");
  options.poses.count = 4;
  options.is_whole_path = false;
  EXPECT_EQ(refusal(options), "") << "a share may have others beside it";
}

/// Of one hour: all that is compared is every tenth picture of it with that of another renderer.
EvaluationOptions oneHour(const TemporaryFolder& folder, const std::string& name, const PoseRange& poses) {
  EvaluationOptions options = experimentOf(folder, 0);
  options.streams = {"h12", "self_test/h12"};
  options.pairs = {{"h12", "self_test/h12", 10}};
  options.poses = poses;
  options.output_dir = folder.file(name);
  return options;
}

PoseRange posesBetween(std::int64_t first, std::int64_t end) {
  PoseRange range;
  range.first = first;
  range.count = static_cast<std::size_t>(end - first);
  return range;
}

void feedHour(Evaluation& evaluation, std::int64_t first, std::int64_t end) {
  for (std::int64_t pose = first; pose < end; ++pose) {
    evaluation.addImage(0, stampOf(pose), picture(pose, 0));
    if (pose % 10 == 0) evaluation.addImage(1, stampOf(pose), picture(pose, 0));
  }
  evaluation.waitForRoom(0);
}

TEST(TakenUpRun, LacksNoPoseOfWhichNothingIsCompared) {
  const TemporaryFolder folder;
  const EvaluationOptions options = oneHour(folder, "out", posesBetween(0, 25));
  {
    Evaluation broken_off(options, {});
    EXPECT_EQ(broken_off.counts().completed_poses, 0u);
    feedHour(broken_off, 0, 14);
    EXPECT_EQ(broken_off.finish().absent_poses, 11u);
  }
  Evaluation evaluation(options, {});
  EXPECT_EQ(evaluation.counts().passed_poses, 20u) << "where it goes on";
  feedHour(evaluation, 20, 25);
  EXPECT_TRUE(evaluation.isComplete());
  EXPECT_TRUE(evaluation.finish().isWhole());
  Evaluation again(options, {});
  EXPECT_TRUE(again.isComplete());
  EXPECT_EQ(again.finish().absent_poses, 0u);
  EXPECT_EQ(contentOf(folder.file("out/problems.csv")), "kind,pose,stamp,where,reason\n");
}

TEST(TakenUpRun, LacksOnlyTheHoleThatItHas) {
  const TemporaryFolder folder;
  const EvaluationOptions options = oneHour(folder, "out", posesBetween(0, 45));
  {
    Evaluation killed(options, {});
    feedHour(killed, 0, 10);
    feedHour(killed, 20, 31);
  }
  Evaluation evaluation(options, {});
  EXPECT_EQ(evaluation.counts().completed_poses, 39u);
  EXPECT_EQ(evaluation.counts().passed_poses, 10u);
  feedHour(evaluation, 10, 11);
  EXPECT_EQ(evaluation.counts().passed_poses, 40u);
  EXPECT_FALSE(evaluation.isComplete()) << "what lies beyond the last has not come yet";
  feedHour(evaluation, 40, 45);
  EXPECT_TRUE(evaluation.finish().isWhole());
}

TEST(TakenUpRun, ThatIsMergedLacksNoPoseOfWhichNothingIsCompared) {
  const TemporaryFolder folder;
  EvaluationOptions all = oneHour(folder, "merged", posesBetween(0, 25));
  for (const auto& [name, first, end] :
       {std::tuple<std::string, std::int64_t, std::int64_t>{"start", 0, 8}, {"end", 8, 25}}) {
    Evaluation share(oneHour(folder, name, posesBetween(first, end)), {});
    feedHour(share, first, end);
    EXPECT_TRUE(share.finish().isWhole());
    all.merge.push_back(folder.file(name));
  }
  Evaluation evaluation(all, {});
  EXPECT_TRUE(evaluation.isComplete());
  const Outcome outcome = evaluation.finish();
  EXPECT_EQ(outcome.absent_poses, 0u);
  EXPECT_TRUE(outcome.isWhole());
}

}  // namespace
}  // namespace sunlit::evaluate
