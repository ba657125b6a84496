// A folder in which an earlier run left something.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace sunlit::evaluate
