#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "support/message_of.h"
#include "unit/evaluate/run/small_evaluation.h"

namespace sunlit::evaluate {
namespace {

std::string undisturbedSummary(int poses) {
  const TemporaryFolder folder;
  Evaluation evaluation(optionsFor(folder), {});
  for (int pose = 0; pose < poses; ++pose) feedPose(evaluation, pose);
  EXPECT_TRUE(evaluation.finish().isWhole());
  return contentOf(folder.file("out/summary.csv"));
}

TEST(Evaluation, CompletesWhenAllExpectedPosesAreIn) {
  const TemporaryFolder folder;
  EvaluationOptions options = optionsFor(folder);
  options.poses.count = 3;
  Evaluation evaluation(options, {});
  feedPose(evaluation, 0);
  feedPose(evaluation, 1);
  evaluation.waitForRoom(0);
  EXPECT_FALSE(evaluation.isComplete());
  feedPose(evaluation, 2);
  evaluation.waitForRoom(0);
  EXPECT_TRUE(evaluation.isComplete());
  const Outcome outcome = evaluation.finish();
  EXPECT_TRUE(outcome.isWhole());
  EXPECT_EQ(outcome.summary.size(), 6u);
  EXPECT_EQ(outcome.summary[0].statistics.n, 3u);
}

TEST(Evaluation, NamesAPoseThatNeverCame) {
  const TemporaryFolder folder;
  EvaluationOptions options = optionsFor(folder);
  options.poses.count = 3;
  Evaluation evaluation(options, {});
  feedPose(evaluation, 0);
  const Outcome outcome = evaluation.finish();
  EXPECT_EQ(outcome.absent_poses, 2u);
  EXPECT_TRUE(hasLine(contentOf(folder.file("out/problems.csv")), "absent,2,,,no image of this pose came"));
  EXPECT_FALSE(outcome.isWhole());
}

TEST(Evaluation, GivesTheSameSummaryInAnyOrderOfArrival) {
  const int poses = 40;
  const std::string expected = undisturbedSummary(poses);
  std::vector<std::pair<int, std::size_t>> arrivals;
  for (int pose = 0; pose < poses; ++pose) {
    for (std::size_t s = 0; s < 3; ++s) arrivals.emplace_back(pose, s);
  }
  std::shuffle(arrivals.begin(), arrivals.end(), std::mt19937(4));
  const TemporaryFolder folder;
  Evaluation evaluation(optionsFor(folder), {});
  for (const auto& arrival : arrivals) {
    evaluation.addImage(arrival.second, stampOf(arrival.first), picture(arrival.first, arrival.second));
  }
  const Outcome outcome = evaluation.finish();
  EXPECT_TRUE(outcome.isWhole());
  EXPECT_GT(outcome.counts.streams[0].out_of_order, 0u);
  EXPECT_EQ(contentOf(folder.file("out/summary.csv")), expected);
  EXPECT_TRUE(hasLine(contentOf(folder.file("out/frames.csv")),
                      "39," + std::string("503.900000000,h12,h20,euclidean_grey")));
}

TEST(Evaluation, NamesProblemsByThePlaceOfTheirStampAndNotByItsArrival) {
  const TemporaryFolder folder;
  Evaluation evaluation(optionsFor(folder), {});
  for (const int pose : {2, 1, 0}) {
    for (std::size_t s = 0; s < 3; ++s) {
      if (pose != 2 || s != 1) evaluation.addImage(s, stampOf(pose), picture(pose, s));
    }
  }
  evaluation.finish();
  const std::string problems = contentOf(folder.file("out/problems.csv"));
  EXPECT_TRUE(hasLine(problems, "missing_partner,2,500.200000000,h04-h12,no image of h12"));
  EXPECT_TRUE(hasLine(problems, "out_of_order,0,500.000000000,h04,"));
}

TEST(Evaluation, CountsAndNamesEverythingThatCannotBeEvaluated) {
  const TemporaryFolder folder;
  Evaluation evaluation(optionsFor(folder), {});
  for (int pose = 0; pose < 6; ++pose) {
    const std::int64_t stamp = stampOf(pose);
    evaluation.addImage(0, stamp, picture(pose, 0));
    if (pose == 1) {
      evaluation.addBadImage(1, stamp, "cut short");
    } else if (pose != 2) {
      evaluation.addImage(1, stamp, picture(pose, 1));
    }
    evaluation.addImage(2, stamp, picture(pose, 2, pose == 3 ? cv::Size(30, 24) : cv::Size(32, 24)));
    if (pose == 4) evaluation.addImage(0, stamp, picture(99, 0));  // the same stamp again, other content
  }
  const Outcome outcome = evaluation.finish();
  EXPECT_FALSE(outcome.isWhole());
  const PairCounts& ab = outcome.counts.pairs[0];
  EXPECT_EQ(ab.evaluated, 4u);
  EXPECT_EQ(ab.undecodable, 1u);
  EXPECT_EQ(ab.missing_partner, 1u);
  const PairCounts& ac = outcome.counts.pairs[1];
  EXPECT_EQ(ac.evaluated, 5u);
  EXPECT_EQ(ac.size_mismatch, 1u);
  EXPECT_EQ(outcome.counts.streams[0].duplicate, 1u);
  EXPECT_EQ(outcome.counts.streams[0].received, 7u);
  EXPECT_EQ(outcome.counts.streams[1].undecodable, 1u);
  const std::string problems = contentOf(folder.file("out/problems.csv"));
  EXPECT_TRUE(hasLine(problems, "undecodable,1,500.100000000,h12,cut short"));
  EXPECT_TRUE(hasLine(problems, "undecodable,1,500.100000000,h04-h12,image of h12: cut short"));
  EXPECT_TRUE(hasLine(problems, "missing_partner,2,500.200000000,h04-h12,no image of h12"));
  EXPECT_TRUE(hasLine(problems, "size_mismatch,3,500.300000000,h04-h20,32x24 against 30x24"));
  EXPECT_TRUE(hasLine(problems, "duplicate,4,500.400000000,h04,"));
}

TEST(Evaluation, IsNotWholeWhereMostImagesOfAStreamHaveStampsThatHadComeBefore) {
  for (const int distinct : {1, 2, 3}) {
    const TemporaryFolder folder;
    Evaluation evaluation(optionsFor(folder), {});
    for (int image = 0; image < 6; ++image) feedPose(evaluation, image % distinct);
    const Outcome outcome = evaluation.finish();
    const StreamCounts& stream = outcome.counts.streams[0];
    EXPECT_EQ(stream.received - stream.duplicate, static_cast<std::size_t>(distinct));
    EXPECT_EQ(outcome.counts.pairs[0].evaluated, static_cast<std::size_t>(distinct));
    EXPECT_EQ(stream.isMostlyDuplicate(), distinct < 3);
    EXPECT_EQ(outcome.isWhole(), distinct == 3) << "as many of each";
    EXPECT_EQ(stream.only_stamp_ns, distinct == 1 ? std::make_optional(stampOf(0)) : std::nullopt);
  }
}

TEST(Evaluation, TakesUpARunThatWasCutOff) {
  const int poses = 30;
  const std::string expected = undisturbedSummary(poses);
  const TemporaryFolder folder;
  {
    Evaluation evaluation(optionsFor(folder), {});
    for (int pose = 0; pose < 17; ++pose) feedPose(evaluation, pose);
    evaluation.waitForRoom(0);
  }  // ends without finish(), as a killed process does
  const std::string frames = contentOf(folder.file("out/frames.csv"));
  setContent(folder.file("out/frames.csv"), frames.substr(0, frames.size() - 20));  // torn end
  std::vector<std::string> notes;
  EvaluationCallbacks callbacks;
  callbacks.note = [&](const std::string& line) { notes.push_back(line); };
  Evaluation evaluation(optionsFor(folder), callbacks);
  for (int pose = 0; pose < poses; ++pose) feedPose(evaluation, pose);
  const Outcome outcome = evaluation.finish();
  EXPECT_TRUE(outcome.isWhole());
  std::size_t evaluated = 0;
  std::size_t resumed = 0;
  for (const PairCounts& pair : outcome.counts.pairs) {
    evaluated += pair.evaluated;
    resumed += pair.resumed;
  }
  EXPECT_EQ(resumed, 3u * 17 - 1);
  EXPECT_EQ(evaluated, 3u * 13 + 1);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("50 evaluated pairs of 16 whole poses"), std::string::npos) << notes[0];
  EXPECT_NE(notes[0].find("torn end"), std::string::npos) << notes[0];
  EXPECT_EQ(contentOf(folder.file("out/summary.csv")), expected);
}

TEST(Evaluation, KeepsTheProblemsOfTheRunsThatItTakesUpOnceEach) {
  const TemporaryFolder folder;
  EvaluationOptions options = optionsFor(folder);
  options.frame_rate = 10.0;
  options.stamp_start_ns = stampOf(0);
  options.poses.count = 4;
  // Pose 1 lacks an image that never comes; the second run sees what pose 2 lacked, and pose 3; a bad image
  // of pose 0 beside a good one cannot be mended.
  const auto feed = [&](Evaluation& evaluation, bool is_second) {
    feedPose(evaluation, 0);
    if (!is_second) evaluation.addBadImage(0, stampOf(0), "cut \"short\", it seems");
    for (const std::int64_t pose : {1, 2, 3}) {
      if (pose == 3 && !is_second) continue;
      evaluation.addImage(0, stampOf(pose), picture(pose, 0));
      evaluation.addImage(2, stampOf(pose), picture(pose, 2));
      if (is_second && pose > 1) evaluation.addImage(1, stampOf(pose), picture(pose, 1));
    }
  };
  const auto problemsAfter = [&](bool is_second) {
    Evaluation evaluation(options, {});
    feed(evaluation, is_second);
    evaluation.finish();
    return contentOf(folder.file("out/problems.csv"));
  };
  const std::string first = problemsAfter(false);
  for (const char* line :
       {"missing_partner,1,500.100000000,h04-h12,", "missing_partner,2,500.200000000,h12-h20,", "absent,3,,,",
        "undecodable,0,500.000000000,h04,\"cut \"\"short\"\", it seems\""}) {
    EXPECT_TRUE(hasLine(first, line)) << line << "\n" << first;
  }
  // Killed while it wrote the last line.
  std::ofstream(folder.file("out/problems.csv"), std::ios::app) << "missing_partner,1,500.1000";
  const std::string second = problemsAfter(true);
  for (const char* line :
       {"missing_partner,1,500.100000000,h04-h12,", "missing_partner,1,500.100000000,h12-h20,",
        "undecodable,0,500.000000000,h04,\"cut \"\"short\"\", it seems\""}) {
    EXPECT_TRUE(hasLine(second, line)) << line << "\n" << second;
  }
  EXPECT_EQ(second.find("missing_partner,2"), std::string::npos) << second;
  EXPECT_EQ(second.find("absent"), std::string::npos) << second;
  EXPECT_EQ(problemsAfter(true), second);  // nothing new, nothing twice
}

TEST(Evaluation, IsCompleteAtOnceOnAFinishedFolder) {
  const TemporaryFolder folder;
  EvaluationOptions options = optionsFor(folder);
  options.poses.count = 4;
  {
    Evaluation evaluation(options, {});
    for (int pose = 0; pose < 4; ++pose) feedPose(evaluation, pose);
    evaluation.finish();
  }
  const std::string summary = contentOf(folder.file("out/summary.csv"));
  const std::string frames = contentOf(folder.file("out/frames.csv"));
  Evaluation again(options, {});
  EXPECT_TRUE(again.isComplete());
  EXPECT_TRUE(again.finish().isWhole());
  EXPECT_EQ(contentOf(folder.file("out/summary.csv")), summary);
  EXPECT_EQ(contentOf(folder.file("out/frames.csv")), frames);
}

TEST(Evaluation, RefusesAFolderOfOtherSettingsNamingThem) {
  const TemporaryFolder folder;
  EvaluationOptions options = optionsFor(folder);
  options.about = {{"date", "2024-07-01"}, {"hours", "[5, 13, 20.5]"}, {"world", "track 7"}};
  {
    Evaluation evaluation(options, {});
    feedPose(evaluation, 0);
    evaluation.finish();
  }
  const auto refusal = [](const EvaluationOptions& other) {
    return messageOf([&] { Evaluation(other, {}); });
  };
  EXPECT_EQ(refusal(options), "");
  EvaluationOptions other = options;
  other.comparer.ratio_test.ratio = 0.75;
  EXPECT_NE(refusal(other).find("ratio was 0.5, now 0.75"), std::string::npos) << refusal(other);
  other = options;
  other.about[0].second = "it's another";
  EXPECT_NE(refusal(other).find("about/date was 2024-07-01, now it's another"), std::string::npos)
      << refusal(other);
  other.comparer.ratio_test.ratio = 0.75;
  EXPECT_NE(refusal(other).find("about/date was"), std::string::npos) << "what others may follow from";
  other = options;
  other.about[1].second = "[ 5.0,13,  20.50]";
  EXPECT_EQ(refusal(other), "") << "spelt otherwise";
  for (const char* hours : {"[5, 13, 20.6]", "[5, 13]", "[513, 20.5]", "5, 13, 20.5"}) {
    other.about[1].second = hours;
    EXPECT_NE(refusal(other), "") << hours;
  }
  for (const char* world : {"track7", "track  7", "track 7 ", "track\n7"}) {
    other = options;
    other.about[2].second = world;
    EXPECT_NE(refusal(other), "") << world;
  }
}

TEST(Evaluation, TakesAFolderOfOtherSettingsInWhichNothingWasEvaluatedYet) {
  const TemporaryFolder folder;
  EvaluationOptions options = optionsFor(folder);
  options.poses.count = 1;
  options.about = {{"width", "0"}};
  EXPECT_FALSE(Evaluation(options, {}).finish().isWhole());  // as where the renderer refused that width
  EXPECT_TRUE(hasLine(contentOf(folder.file("out/problems.csv")), "absent,0,"));
  options.about = {{"width", "640"}};
  {
    Evaluation evaluation(options, {});
    feedPose(evaluation, 0);
    EXPECT_TRUE(evaluation.finish().isWhole());
  }
  EXPECT_FALSE(hasLine(contentOf(folder.file("out/problems.csv")), "absent,0,"));
  EXPECT_NE(contentOf(folder.file("out/run.yaml")).find("about/width: '640'"), std::string::npos);
}

TEST(Evaluation, NumbersPosesByTheirCaptures) {
  const TemporaryFolder folder;
  EvaluationOptions options = optionsFor(folder);
  options.streams = {"h04", "h12"};
  options.pairs = {{"h04", "h12", 10}};
  Evaluation evaluation(options, {});
  for (std::int64_t pose = 35; pose >= 0; --pose) {
    CaptureRecord capture;
    capture.pose = pose;
    capture.stamp_ns = stampOf(7 * pose);
    capture.exposure_mode = pose % 2 == 0 ? "fixed" : "auto";
    capture.moon_azimuth_deg = std::nan("");  // as without a night
    capture.moon_elevation_deg = -12.5;
    capture.moon_illuminated_fraction = 0.75;
    for (std::size_t s = 0; s < 2; ++s) {
      evaluation.addCapture(s, capture);
      evaluation.addImage(s, capture.stamp_ns, picture(pose, s));
    }
  }
  const Outcome outcome = evaluation.finish();
  EXPECT_TRUE(outcome.isWhole());
  EXPECT_EQ(outcome.counts.pairs[0].evaluated, 4u);  // 0, 10, 20, 30
  EXPECT_TRUE(hasLine(contentOf(folder.file("out/frames.csv")), "30,521.000000000,h04,h12,boolean_rgb"));
  const std::string captures = contentOf(folder.file("out/captures.csv"));
  EXPECT_TRUE(hasLine(captures, "h12,34,523.800000000,0,fixed,0,0,nan,-12.5,0.75,0,,nan"));
  EXPECT_TRUE(hasLine(captures, "h12,35,524.500000000,0,auto,0,0,nan,-12.5,0.75,0,,nan"));
}

TEST(Evaluation, NumbersPosesByTheFrameRate) {
  const TemporaryFolder folder;
  EvaluationOptions options = optionsFor(folder);
  options.frame_rate = 10.0;
  options.stamp_start_ns = stampOf(0);
  Evaluation evaluation(options, {});
  feedPose(evaluation, 12);
  evaluation.finish();
  EXPECT_TRUE(hasLine(contentOf(folder.file("out/frames.csv")), "12,501.200000000,h04,h12,"));
}

TEST(Evaluation, CountsAndNamesStampsBeforeTheFirstPose) {
  const TemporaryFolder folder;
  EvaluationOptions options = optionsFor(folder);
  options.frame_rate = 10.0;
  options.stamp_start_ns = stampOf(0);
  options.poses.count = 2;
  Evaluation evaluation(options, {});
  feedPose(evaluation, -1);
  feedPose(evaluation, 0);
  evaluation.waitForRoom(0);
  EXPECT_FALSE(evaluation.isComplete());  // what lies before the path is not one of its two poses
  feedPose(evaluation, 1);
  const Outcome outcome = evaluation.finish();
  EXPECT_FALSE(outcome.isWhole());
  EXPECT_EQ(outcome.counts.pairs[0].unplaced, 1u);
  EXPECT_EQ(outcome.summary[0].statistics.n, 2u);
  EXPECT_TRUE(hasLine(contentOf(folder.file("out/problems.csv")), "unplaced,,"));
}

TEST(Evaluation, KeepsFiveEvenlySpreadPicturesUnderTheirFinalNumbers) {
  const TemporaryFolder folder;
  EvaluationOptions options = optionsFor(folder);
  options.poses.count = 21;
  Evaluation evaluation(options, {});
  for (int pose = 0; pose < 21; ++pose) feedPose(evaluation, pose);
  evaluation.finish();
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.file("out/images/h12"))) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names,
            (std::vector<std::string>{"000000.png", "000005.png", "000010.png", "000015.png", "000020.png"}));
}

TEST(Evaluation, RefusesBadOptionsByName) {
  const TemporaryFolder folder;
  EvaluationOptions options = optionsFor(folder);
  options.pairs = {{"h04", "h05", 1}};
  EXPECT_THROW(Evaluation(options, {}), std::invalid_argument);
  options = optionsFor(folder);
  options.streams = {"h04"};
  EXPECT_THROW(Evaluation(options, {}), std::invalid_argument);
  options.streams = {"h04", "h04"};
  EXPECT_THROW(Evaluation(options, {}), std::invalid_argument);
  options = optionsFor(folder);
  options.output_dir = "/proc/nowhere";
  EXPECT_THROW(Evaluation(options, {}), std::runtime_error);
}

}  // namespace
}  // namespace sunlit::evaluate
