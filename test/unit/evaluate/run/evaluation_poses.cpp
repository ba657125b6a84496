#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sunlit/evaluate/differences/feature_difference.h"
#include "support/moody_detector.h"
#include "unit/evaluate/run/small_evaluation.h"

namespace sunlit::evaluate {
namespace {

constexpr int kStamps = 60;

// A camera of 30.3 Hz taken for one of 30 Hz: stamps 50 and 51 both round to pose 50.
std::int64_t stampOfFastCamera(int i) {
  return stampOf(0) + std::llround(i * 1e9 / 30.3);
}

EvaluationOptions fastCameraOptions(const TemporaryFolder& folder) {
  EvaluationOptions options = optionsFor(folder);
  options.frame_rate = 30.0;
  options.stamp_start_ns = stampOf(0);
  options.images = KeptImages::kAll;
  return options;
}

void feedFastCamera(Evaluation& evaluation, int i) {
  for (std::size_t s = 0; s < 3; ++s) evaluation.addImage(s, stampOfFastCamera(i), picture(i, s));
}

struct Results {
  Outcome outcome;
  std::string frames;
  std::string summary;
  std::string problems;
  std::string picture_of_50;
};

Results resultsOf(const TemporaryFolder& folder, const Outcome& outcome) {
  return {outcome, contentOf(folder.file("out/frames.csv")), contentOf(folder.file("out/summary.csv")),
          contentOf(folder.file("out/problems.csv")), contentOf(folder.file("out/images/h12/000050.png"))};
}

// `is_paced`: each stamp is evaluated before the next one comes.
Results resultsOf(const std::vector<int>& order, bool is_paced) {
  const TemporaryFolder folder;
  Evaluation evaluation(fastCameraOptions(folder), {});
  for (const int i : order) {
    feedFastCamera(evaluation, i);
    if (is_paced) evaluation.waitForRoom(0);
  }
  return resultsOf(folder, evaluation.finish());
}

std::vector<int> inOrder() {
  std::vector<int> order;
  for (int i = 0; i < kStamps; ++i) order.push_back(i);
  return order;
}

std::string linesOf(const std::string& text, const std::string& kind) {
  std::string lines;
  std::stringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind(kind, 0) == 0) lines += line + "\n";
  }
  return lines;
}

TEST(TwoStampsOfOnePose, AreOnePairThatCountsAndADuplicateThatIsNamed) {
  const Results results = resultsOf(inOrder(), true);
  EXPECT_FALSE(results.outcome.isWhole());
  for (const PairCounts& pair : results.outcome.counts.pairs) {
    EXPECT_EQ(pair.evaluated, kStamps - 1u);
    EXPECT_EQ(pair.duplicate, 1u);
  }
  EXPECT_TRUE(hasLine(results.problems, "duplicate,50,501.683168317,h04-h12,")) << results.problems;
  EXPECT_TRUE(hasLine(results.frames, "50,501.650165017,h04,h12,")) << results.frames;
  EXPECT_FALSE(hasLine(results.frames, "50,501.683168317,")) << results.frames;
}

TEST(TwoStampsOfOnePose, GiveTheSameFilesWhateverTheOrderAndTheTime) {
  const Results expected = resultsOf(inOrder(), true);
  std::vector<int> backwards = inOrder();
  std::reverse(backwards.begin(), backwards.end());
  std::vector<int> shuffled = inOrder();
  std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(4));
  for (const bool is_paced : {true, false}) {
    for (const std::vector<int>& order : {inOrder(), backwards, shuffled}) {
      const Results results = resultsOf(order, is_paced);
      EXPECT_EQ(results.frames, expected.frames);
      EXPECT_EQ(results.summary, expected.summary);
      EXPECT_EQ(results.picture_of_50, expected.picture_of_50);
      EXPECT_EQ(linesOf(results.problems, "duplicate"), linesOf(expected.problems, "duplicate"));
      for (const PairCounts& pair : results.outcome.counts.pairs) {
        EXPECT_EQ(pair.evaluated, kStamps - 1u);
        EXPECT_EQ(pair.duplicate, 1u);
      }
    }
  }
}

TEST(TwoStampsOfOnePose, DoNotHideThatOneOfThemLacksAnImage) {
  const TemporaryFolder folder;
  Evaluation evaluation(fastCameraOptions(folder), {});
  evaluation.addImage(0, stampOfFastCamera(50), picture(50, 0));
  evaluation.addImage(2, stampOfFastCamera(50), picture(50, 2));
  feedFastCamera(evaluation, 51);
  const Results results = resultsOf(folder, evaluation.finish());
  EXPECT_EQ(results.outcome.counts.pairs[0].missing_partner, 1u);
  EXPECT_EQ(results.outcome.counts.pairs[0].evaluated, 1u);
  EXPECT_EQ(results.outcome.counts.pairs[1].duplicate, 1u);
  EXPECT_TRUE(hasLine(results.problems, "missing_partner,50,501.650165017,h04-h12,")) << results.problems;
  EXPECT_TRUE(hasLine(results.problems, "duplicate,50,501.683168317,h04-h20,")) << results.problems;
  EXPECT_TRUE(hasLine(results.frames, "50,501.683168317,h04,h12,")) << results.frames;
  EXPECT_TRUE(hasLine(results.frames, "50,501.650165017,h04,h20,")) << results.frames;
}

TEST(TwoStampsOfOnePose, GiveTheSameFilesWhereARunWasCutOff) {
  const Results expected = resultsOf(inOrder(), true);
  const TemporaryFolder folder;
  {
    Evaluation evaluation(fastCameraOptions(folder), {});
    for (int i = 0; i < 51; ++i) feedFastCamera(evaluation, i);
    evaluation.waitForRoom(0);
  }  // ends without finish(), as a killed process does
  Evaluation evaluation(fastCameraOptions(folder), {});
  for (const int i : inOrder()) feedFastCamera(evaluation, i);
  const Results results = resultsOf(folder, evaluation.finish());
  EXPECT_FALSE(results.outcome.isWhole());
  EXPECT_EQ(results.frames, expected.frames);
  EXPECT_EQ(results.problems, expected.problems);
}

// Stamp 50, which counts, had not been evaluated yet.
TEST(TwoStampsOfOnePose, GiveTheSameFilesWhereARunWasCutOffBetweenThem) {
  const Results expected = resultsOf(inOrder(), true);
  std::vector<int> backwards = inOrder();
  std::reverse(backwards.begin(), backwards.end());
  for (const std::vector<int>& order : {inOrder(), backwards}) {
    const TemporaryFolder folder;
    {
      Evaluation evaluation(fastCameraOptions(folder), {});
      for (const int i : {49, 51}) feedFastCamera(evaluation, i);
      evaluation.waitForRoom(0);
    }
    Evaluation evaluation(fastCameraOptions(folder), {});
    for (const int i : order) feedFastCamera(evaluation, i);
    const Results results = resultsOf(folder, evaluation.finish());
    EXPECT_EQ(results.frames, expected.frames);
    EXPECT_EQ(results.picture_of_50, expected.picture_of_50);
    EXPECT_EQ(linesOf(results.problems, "duplicate"), linesOf(expected.problems, "duplicate"));
    for (const PairCounts& pair : results.outcome.counts.pairs) {
      EXPECT_EQ(pair.resumed, 1u);
      EXPECT_EQ(pair.evaluated, kStamps - 2u);
      EXPECT_EQ(pair.duplicate, 1u);
    }
  }
}

// What an earlier run made of the later stamp stays where the one that counts fails.
TEST(TwoStampsOfOnePose, LoseNothingToOneThatFails) {
  const TemporaryFolder folder;
  EvaluationOptions options = fastCameraOptions(folder);
  options.comparer.known.add("moody", makeFeatureDifference(moodyDetector()));
  options.comparer.differences = {"boolean_rgb", "moody"};
  const auto feed = [](Evaluation& evaluation, int i, bool is_bad) {
    for (std::size_t s = 0; s < 3; ++s) {
      const cv::Mat image = picture(i, s, {120, 90});
      evaluation.addImage(s, stampOfFastCamera(i), is_bad ? marked(image) : image);
    }
  };
  std::string later;
  {
    Evaluation evaluation(options, {});
    feed(evaluation, 51, false);
    evaluation.finish();
    later = contentOf(folder.file("out/frames.csv"));
    ASSERT_TRUE(hasLine(later, "50,501.683168317,h04,h12,")) << later;
  }
  Evaluation evaluation(options, {});
  feed(evaluation, 50, true);
  const Outcome outcome = evaluation.finish();
  EXPECT_EQ(outcome.counts.pairs[0].failed, 1u);
  EXPECT_EQ(outcome.counts.pairs[0].resumed, 1u);
  EXPECT_EQ(contentOf(folder.file("out/frames.csv")), later);
}

TEST(TwoStampsOfOnePose, HaveTheCaptureOfTheOneThatCounts) {
  const TemporaryFolder folder;
  const auto evaluate = [&](const std::string& out, const std::vector<std::int64_t>& stamps,
                            const std::vector<std::string>& merge) {
    EvaluationOptions options = optionsFor(folder);
    options.output_dir = folder.file(out);
    options.merge = merge;
    Evaluation evaluation(options, {});
    for (const std::int64_t stamp : stamps) {
      CaptureRecord capture;
      capture.pose = 7;
      capture.stamp_ns = stampOf(stamp);
      capture.ev100 = static_cast<double>(stamp);
      evaluation.addCapture(1, capture);
      feedPose(evaluation, stamp);
    }
    evaluation.finish();
    return options.output_dir;
  };
  const std::string earlier = evaluate("earlier", {5}, {}), later = evaluate("later", {6}, {});
  for (const std::string& out : {evaluate("in_order", {5, 6}, {}), evaluate("backwards", {6, 5}, {}),
                                 evaluate("merged", {}, {earlier, later})}) {
    EXPECT_TRUE(hasLine(contentOf(out + "/frames.csv"), "7,500.500000000,h04,h12,")) << out;
    const std::string captures = contentOf(out + "/captures.csv");
    EXPECT_TRUE(hasLine(captures, "h12,7,500.500000000,5,")) << out << "\n" << captures;
    EXPECT_FALSE(hasLine(captures, "h12,7,500.600000000,")) << out << "\n" << captures;
  }
}

// The folder of a run that evaluated some stamps only.
std::string shard(const TemporaryFolder& folder, const std::string& name, int begin, int end) {
  EvaluationOptions options = optionsFor(folder);
  options.output_dir = folder.file(name);
  Evaluation evaluation(options, {});
  for (int pose = begin; pose < end; ++pose) feedPose(evaluation, pose);
  EXPECT_TRUE(evaluation.finish().isWhole());
  return options.output_dir;
}

Outcome merged(const TemporaryFolder& folder, const std::vector<std::string>& shards, std::size_t poses) {
  EvaluationOptions options = optionsFor(folder);
  options.merge = shards;
  options.poses.count = poses;
  Evaluation evaluation(options, {});
  EXPECT_TRUE(evaluation.isComplete());
  return evaluation.finish();
}

TEST(Merging, NumbersThePosesOfAllShardsByTheOrderOfTheirStamps) {
  const TemporaryFolder folder;
  const std::string whole = shard(folder, "whole", 0, 11);
  const std::string start = shard(folder, "start", 0, 4);
  const std::string end = shard(folder, "end", 4, 11);
  const Outcome outcome = merged(folder, {end, start}, 11);
  EXPECT_TRUE(outcome.isWhole());
  EXPECT_EQ(outcome.absent_poses, 0u);
  EXPECT_EQ(outcome.counts.completed_poses, 11u);
  for (const PairCounts& pair : outcome.counts.pairs) EXPECT_EQ(pair.resumed, 11u);
  EXPECT_EQ(contentOf(folder.file("out/frames.csv")), contentOf(whole + "/frames.csv"));
}

TEST(Merging, CountsWhatTwoShardsBothHoldOnce) {
  const TemporaryFolder folder;
  const std::string whole = shard(folder, "whole", 0, 11);
  const std::string start = shard(folder, "start", 0, 7);
  const std::string end = shard(folder, "end", 4, 11);
  const Outcome outcome = merged(folder, {start, end}, 11);
  EXPECT_TRUE(outcome.isWhole());
  EXPECT_EQ(outcome.counts.completed_poses, 11u);
  for (const PairCounts& pair : outcome.counts.pairs) EXPECT_EQ(pair.resumed, 11u);
  EXPECT_EQ(contentOf(folder.file("out/frames.csv")), contentOf(whole + "/frames.csv"));
}

/// Of four poses, at one of which h12 sends nothing, or half an image; or of other runs alone.
Outcome lacking(const TemporaryFolder& folder, const std::string& name, std::int64_t lacks,
                const std::vector<std::string>& merge, bool is_cut_short = false) {
  EvaluationOptions options = optionsFor(folder);
  options.output_dir = folder.file(name);
  options.merge = merge;
  Evaluation evaluation(options, {});
  for (std::int64_t pose = 0; merge.empty() && pose < 4; ++pose) {
    CaptureRecord capture;
    capture.pose = pose;
    capture.stamp_ns = stampOf(pose);
    evaluation.addCapture(0, capture);
    for (std::size_t s = 0; s < 3; ++s) {
      const bool is_missing = pose == lacks && s == 1;
      if (is_missing && is_cut_short) evaluation.addBadImage(s, stampOf(pose), "ends within a row");
      if (!is_missing) evaluation.addImage(s, stampOf(pose), picture(pose, s));
    }
  }
  return evaluation.finish();
}

TEST(Merging, IsNotWholeBeforeWhatItsRunsLackWasEvaluated) {
  const TemporaryFolder folder;
  EXPECT_FALSE(lacking(folder, "lacks", 2, {}).isWhole());
  const Outcome merged = lacking(folder, "merged", -1, {folder.file("lacks")});
  EXPECT_FALSE(merged.isWhole());
  EXPECT_EQ(merged.not_mended, 2u) << "the pairs of h12 with each other";
  EXPECT_TRUE(hasLine(contentOf(folder.file("merged/problems.csv")),
                      "missing_partner,2,500.200000000,h04-h12,no image of h12"));
  EXPECT_NE(contentOf(folder.file("merged/run.yaml")).find("whole: false"), std::string::npos);
  EXPECT_NE(contentOf(folder.file("merged/run.yaml")).find("not_mended: 2"), std::string::npos);
  lacking(folder, "whole", -1, {});
  EXPECT_TRUE(lacking(folder, "both", -1, {folder.file("lacks"), folder.file("whole")}).isWhole());
  EXPECT_EQ(contentOf(folder.file("both/problems.csv")), "kind,pose,stamp,where,reason\n");
  EXPECT_TRUE(lacking(folder, "merged", -1, {folder.file("whole")}).isWhole()) << "goes on";
}

TEST(AnImageThatWasCutShort, IsNoProblemOfTheRunThatGetsItWhole) {
  const TemporaryFolder folder;
  EXPECT_FALSE(lacking(folder, "out", 2, {}, true).isWhole());
  EXPECT_TRUE(hasLine(contentOf(folder.file("out/problems.csv")), "undecodable,2,500.200000000,h12,"));
  EXPECT_TRUE(lacking(folder, "out", -1, {}).isWhole());
  EXPECT_EQ(contentOf(folder.file("out/problems.csv")), "kind,pose,stamp,where,reason\n");
}

TEST(WhereTheCameraStood, IsLeftOutAndNamedWhereItIsNoPlace) {
  const TemporaryFolder folder;
  Evaluation evaluation(optionsFor(folder), {});
  for (std::int64_t pose = 0; pose < 3; ++pose) {
    evaluation.addPlace({stampOf(pose), 1.0, 2.0, 3.0, pose == 1 ? std::nan("") : 90.0});
    feedPose(evaluation, pose);
  }
  evaluation.addPlace({stampOf(2), HUGE_VAL, 2.0, 3.0, 90.0});
  const Outcome outcome = evaluation.finish();
  EXPECT_TRUE(outcome.isWhole());
  EXPECT_EQ(contentOf(folder.file("out/path.csv")),
            "pose,stamp,x,y,z,yaw_deg\n0,500.000000000,1,2,3,90\n2,500.200000000,1,2,3,90\n");
  const std::string problems = contentOf(folder.file("out/problems.csv"));
  EXPECT_TRUE(hasLine(problems, "unusable,,500.100000000,pose,")) << problems;
  EXPECT_TRUE(hasLine(problems, "unusable,,500.200000000,pose,")) << problems;
}

constexpr int kPlacesAPose = 5;  // a camera/pose of 50 Hz beside images of 10 Hz

/// The i-th of those places, which stands at x = i, comes so late.
PlaceRecord placeOf50Hz(std::int64_t i, std::int64_t late_ns = 0) {
  return {stampOf(0) + i * kFrameNs / kPlacesAPose + late_ns, static_cast<double>(i), 2.0, 3.0, 90.0};
}

/// path.csv where x is 5 times the pose, and the stamp so late.
std::string pathOf(std::int64_t poses, const std::string& late = "00000000") {
  std::string text = "pose,stamp,x,y,z,yaw_deg\n";
  for (std::int64_t pose = 0; pose < poses; ++pose) {
    const std::string tenths = std::to_string(5000 + pose);
    text += std::to_string(pose) + "," + tenths.substr(0, 3) + "." + tenths.substr(3) + late + "," +
            std::to_string(kPlacesAPose * pose) + ",2,3,90\n";
  }
  return text;
}

/// `poses` images and places of twice as many, as they come; says what is noted.
std::string feedPlaces(const EvaluationOptions& options, std::int64_t poses, std::int64_t late_ns,
                       bool is_killed = false) {
  std::string notes;
  const EvaluationCallbacks callbacks = notingTo(&notes);
  Evaluation evaluation(options, callbacks);
  for (std::int64_t i = 0; i < 2 * poses * kPlacesAPose; ++i) {
    const std::int64_t pose = i / kPlacesAPose;
    const bool is_first_half = pose % 2 == 0;  // of these the image comes first
    if (i % kPlacesAPose == 0 && is_first_half && pose < poses) feedPose(evaluation, pose);
    evaluation.addPlace(placeOf50Hz(i, late_ns));
    if (i % kPlacesAPose == 0 && !is_first_half && pose < poses) feedPose(evaluation, pose);
  }
  evaluation.waitForRoom(0);
  if (!is_killed) evaluation.finish();
  return notes;
}

TEST(WhereTheCameraStood, IsThatOfTheStampsOfImagesAndTheRestIsNamedOnce) {
  const TemporaryFolder folder;
  const std::string notes = feedPlaces(optionsFor(folder), 20, 0);
  EXPECT_EQ(contentOf(folder.file("out/path.csv")), pathOf(20));
  EXPECT_NE(notes.find("/path.csv: 180 poses of stamps without an image left out\n"), std::string::npos)
      << notes;
}

TEST(WhereTheCameraStood, IsTheNearestToWhatTheFrameRateGivesAPose) {
  const TemporaryFolder folder;
  EvaluationOptions options = optionsFor(folder);
  options.frame_rate = 10.0;
  options.stamp_start_ns = stampOf(0);
  feedPlaces(options, 20, 3000000);  // 3 ms, of the 20 ms between places
  EXPECT_EQ(contentOf(folder.file("out/path.csv")), pathOf(20, "03000000"));
}

TEST(WhereTheCameraStood, IsTheSameWhereARunWasCutOff) {
  const TemporaryFolder folder;
  feedPlaces(optionsFor(folder), 10, 0, true);
  feedPlaces(optionsFor(folder), 20, 0);
  EXPECT_EQ(contentOf(folder.file("out/path.csv")), pathOf(20));
}

TEST(WhereTheCameraStood, IsForgottenWhereNoImageComesForLong) {
  const TemporaryFolder folder;
  Evaluation evaluation(optionsFor(folder), {});
  for (std::int64_t i = 0; i < 66000; ++i) evaluation.addPlace(placeOf50Hz(i));  // 22 min
  feedPose(evaluation, 0);
  feedPose(evaluation, 13000);
  evaluation.finish();
  EXPECT_EQ(contentOf(folder.file("out/path.csv")),
            "pose,stamp,x,y,z,yaw_deg\n1,1800.000000000,65000,2,3,90\n");
}

}  // namespace
}  // namespace sunlit::evaluate
