// verified.csv and verified_summary.csv of a run.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <opencv2/imgproc.hpp>
#include <random>
#include <set>

#include "evaluate/files/files.h"
#include "sunlit/evaluate/verify/verify.h"
#include "support/message_of.h"
#include "unit/evaluate/features/surf_picture.h"
#include "unit/evaluate/run/small_evaluation.h"

namespace sunlit::evaluate {
namespace {

/// A window of one picture that moves with the pose; each stream by another light.
cv::Mat lit(std::int64_t pose, std::size_t stream) {
  static const cv::Mat whole = test::madePicture(200, 120);
  cv::Mat rgb;
  const cv::Mat window = whole(cv::Rect(static_cast<int>(2 * pose), 0, 150, 120));
  window.convertTo(rgb, CV_8U, 1.0 - 0.2 * static_cast<double>(stream), 9.0 * static_cast<double>(stream));
  cv::cvtColor(rgb, rgb, cv::COLOR_GRAY2RGB);
  return rgb;
}

void feedLit(Evaluation& evaluation, std::int64_t first, std::int64_t end) {
  for (std::int64_t pose = first; pose < end; ++pose) {
    for (std::size_t s = 0; s < evaluation.options().streams.size(); ++s)
      evaluation.addImage(s, stampOf(pose), lit(pose, s));
  }
}

constexpr std::int64_t kPoses = 7;

EvaluationOptions verifying(const TemporaryFolder& folder, const std::string& output = "out") {
  EvaluationOptions options = optionsFor(folder);
  options.output_dir = folder.file(output);
  options.comparer.differences = {"boolean_rgb", "orb", "sift"};
  return options;
}

/// Of a run that nothing befell.
std::map<std::string, std::string> undisturbed(EvaluationOptions options) {
  const TemporaryFolder folder;
  options.output_dir = folder.file("out");
  options.merge.clear();
  Evaluation evaluation(options, {});
  feedLit(evaluation, 0, kPoses);
  EXPECT_TRUE(evaluation.finish().isWhole());
  std::map<std::string, std::string> contents;
  for (const char* name :
       {"frames.csv", "summary.csv", "verified.csv", "verified_summary.csv", "lost_features.csv"})
    contents[name] = contentOf(folder.file(std::string("out/") + name));
  return contents;
}

void expectSame(const std::string& folder, const std::map<std::string, std::string>& contents) {
  for (const auto& [name, content] : contents) EXPECT_EQ(contentOf(folder + "/" + name), content) << name;
}

std::vector<std::vector<std::string>> rowsOf(const std::string& path) {
  const std::string text = contentOf(path);
  std::vector<std::vector<std::string>> rows;
  forEachCsvRow(path, text.substr(0, text.find('\n')), [&](const auto& fields) { rows.push_back(fields); });
  return rows;
}

TEST(VerifiedRun, CountsAndNamesPicturesInWhichADetectorFindsNothing) {
  const TemporaryFolder folder;
  EvaluationOptions options = verifying(folder);
  options.comparer.differences = {"boolean_rgb", "orb", "sift"};
  Evaluation evaluation(options, {});
  feedLit(evaluation, 0, 1);
  const cv::Mat black(120, 150, CV_8UC3, cv::Scalar::all(0));
  for (std::size_t s = 0; s < 2; ++s) evaluation.addImage(s, stampOf(1), lit(1, s));
  evaluation.addImage(2, stampOf(1), black);
  const Outcome outcome = evaluation.finish();
  EXPECT_TRUE(outcome.isWhole()) << "it is compared all the same";
  EXPECT_EQ(outcome.counts.streams[1].no_features, 0u);
  EXPECT_EQ(outcome.counts.streams[2].no_features, 2u) << "once a detector";
  EXPECT_EQ(contentOf(folder.file("out/problems.csv")),
            "kind,pose,stamp,where,reason\n"
            "no_features,1,500.100000000,h20,orb found nothing in it\n"
            "no_features,1,500.100000000,h20,sift found nothing in it\n");
  EXPECT_NE(contentOf(folder.file("out/run.yaml")).find(", no_features: 2, "), std::string::npos);
}

TEST(VerifiedRun, TellsOfEachPairAndDetectorWhatVerifyImagesTells) {
  const TemporaryFolder folder;
  EvaluationOptions options = verifying(folder);
  options.comparer.differences = {"boolean_rgb", "orb", "brisk", "sift"};  // brisk is not verified unasked
  Evaluation evaluation(options, {});
  feedLit(evaluation, 0, kPoses);
  EXPECT_TRUE(evaluation.finish().isWhole());
  const std::string path = folder.file("out/verified.csv");
  const auto rows = rowsOf(path);
  ASSERT_EQ(rows.size(), 7u * 3u * 2u);  // poses, pairs, detectors
  EXPECT_EQ(contentOf(path).rfind("pose,stamp,a,b,detector,features_a,features_b,repeatability,"
                                  "matching_score_3px,mma_1px,",
                                  0),
            0u);
  VerifyOptions alone;
  alone.detectors = {"sift", "orb"};
  const auto expected = verifyImages({lit(3, 0), lit(3, 2)}, identityMaps({150, 120}), alone);
  for (std::size_t d = 0; d < 2; ++d) {
    const auto& row = rows[3 * 6 + 2 + d];  // h04-h20 comes second
    EXPECT_EQ(std::vector<std::string>(row.begin(), row.begin() + 5),
              (std::vector<std::string>{"3", "500.300000000", "h04", "h20", alone.detectors[d]}));
    ASSERT_GT(expected[d].mutual_matches, 10u);
    EXPECT_EQ(row[5], std::to_string(expected[d].difference.features_a));
    EXPECT_EQ(row[7], formatNumber(expected[d].repeatability));
    EXPECT_EQ(row[8], formatNumber(expected[d].matching_score));
    EXPECT_EQ(row[9], formatNumber(expected[d].matching_accuracy[0]));
    EXPECT_EQ(row[18], formatNumber(expected[d].matching_accuracy[9]));
    EXPECT_EQ(row[19], std::to_string(expected[d].mutual_matches));
    EXPECT_EQ(row[21], formatNumber(expected[d].precision));
    EXPECT_EQ(row[26], formatNumber(expected[d].difference.one_to_one));
  }
}

TEST(VerifiedRun, LeavesTheDifferencesAsTheyAre) {
  const TemporaryFolder folder;
  EvaluationOptions options = verifying(folder);
  const auto with = undisturbed(options);
  options.verify.emplace();
  const auto without = undisturbed(options);
  EXPECT_EQ(with.at("frames.csv"), without.at("frames.csv"));
  EXPECT_EQ(with.at("summary.csv"), without.at("summary.csv"));
  EXPECT_EQ(without.at("verified.csv"), "");  // no such file
  EXPECT_EQ(without.at("verified_summary.csv"), "");
}

TEST(VerifiedRun, SummarisesEachMeasureWithItsInterval) {
  const TemporaryFolder folder;
  Evaluation evaluation(verifying(folder), {});
  feedLit(evaluation, 0, kPoses);
  evaluation.finish();
  std::vector<double> precisions;
  for (const auto& row : rowsOf(folder.file("out/verified.csv"))) {
    if (row[2] == "h04" && row[3] == "h12" && row[4] == "orb") precisions.push_back(parseNumber(row[21]));
  }
  const Statistics expected = statisticsOf(precisions);
  ASSERT_EQ(expected.n, 7u);
  const std::string summary = contentOf(folder.file("out/verified_summary.csv"));
  EXPECT_EQ(rowsOf(folder.file("out/verified_summary.csv")).size(), 3u * 2u * 22u);
  EXPECT_TRUE(hasLine(summary, "h04,h12,orb,precision_3px,7,0," + formatNumber(expected.mean) + "," +
                                   formatNumber(expected.sd) + "," + formatNumber(expected.ci_low) + "," +
                                   formatNumber(expected.ci_high)))
      << summary;
}

TEST(VerifiedRun, GivesTheSameBytesInAnyOrderOfArrivalAndForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  const auto expected = undisturbed(verifying(folder));
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  std::vector<std::pair<std::int64_t, std::size_t>> arrivals;
  for (std::int64_t pose = 0; pose < kPoses; ++pose) {
    for (std::size_t s = 0; s < 3; ++s) arrivals.emplace_back(pose, s);
  }
  std::shuffle(arrivals.begin(), arrivals.end(), std::mt19937(4));
  Evaluation evaluation(verifying(folder), {});
  for (const auto& [pose, stream] : arrivals) evaluation.addImage(stream, stampOf(pose), lit(pose, stream));
  evaluation.finish();
  expectSame(folder.file("out"), expected);
}

// Cut off after any number of bytes of either file, as a kill may leave them: verified.csv is ahead, if
// anything, since its rows come first. And even behind, as a machine may leave them that lost its power.
TEST(VerifiedRun, TakesUpARunThatWasCutOffWithoutLosingOrDoublingARow) {
  const TemporaryFolder folder;
  const auto expected = undisturbed(verifying(folder));
  for (const auto& [lost_of_frames, lost_of_verified] : std::vector<std::pair<std::size_t, std::size_t>>{
           {0, 0}, {15, 0}, {700, 0}, {0, 15}, {0, 900}, {300, 5000}}) {
    SCOPED_TRACE(std::to_string(lost_of_frames) + " " + std::to_string(lost_of_verified));
    const std::string output =
        "out" + std::to_string(lost_of_frames) + "_" + std::to_string(lost_of_verified);
    const EvaluationOptions options = verifying(folder, output);
    {
      Evaluation evaluation(options, {});
      feedLit(evaluation, 0, 4);
      evaluation.waitForRoom(0);
    }  // ends without finish(), as a killed process does
    const auto cut = [&](const std::string& name, std::size_t bytes) {
      const std::string path = options.output_dir + "/" + name;
      const std::string content = contentOf(path);
      ASSERT_GT(content.size(), bytes + 500);
      setContent(path, content.substr(0, content.size() - bytes));
    };
    cut("frames.csv", lost_of_frames);
    cut("verified.csv", lost_of_verified);
    Evaluation evaluation(options, {});
    std::size_t resumed = 0;
    for (const PairCounts& pair : evaluation.counts().pairs) resumed += pair.resumed;
    EXPECT_EQ(resumed == 3u * 4u, lost_of_frames + lost_of_verified == 0);
    feedLit(evaluation, 0, kPoses);
    EXPECT_TRUE(evaluation.finish().isWhole());
    expectSame(options.output_dir, expected);
  }
}

TEST(VerifiedRun, IsWrittenAgainAsItIsWhereNothingIsLeftToDo) {
  const TemporaryFolder folder;
  EvaluationOptions options = verifying(folder);
  options.poses.count = kPoses;
  const auto expected = undisturbed(options);
  for (int time = 0; time < 2; ++time) {
    Evaluation evaluation(options, {});
    feedLit(evaluation, 0, time == 0 ? kPoses : 0);
    EXPECT_TRUE(evaluation.finish().isWhole());
    expectSame(options.output_dir, expected);
  }
}

TEST(VerifiedRun, MergesShardsToTheBytesOfTheWhole) {
  const TemporaryFolder folder;
  EvaluationOptions options = verifying(folder);
  const auto expected = undisturbed(options);
  for (const auto& [name, first, end] :
       std::vector<std::tuple<std::string, std::int64_t, std::int64_t>>{{"end", 3, 7}, {"start", 0, 4}}) {
    Evaluation evaluation(verifying(folder, name), {});
    feedLit(evaluation, first, end);  // pose 3 is in both
    evaluation.finish();
    options.merge.push_back(folder.file(name));
  }
  Evaluation evaluation(options, {});
  EXPECT_TRUE(evaluation.finish().isWhole());
  expectSame(options.output_dir, expected);
}

TEST(VerifiedRun, MergesNothingOfWhichAPartIsMissing) {
  const TemporaryFolder folder;
  EvaluationOptions part = verifying(folder, "part");
  {
    Evaluation evaluation(part, {});
    feedLit(evaluation, 0, 2);
    evaluation.finish();
  }
  EvaluationOptions whole = verifying(folder);
  whole.merge = {folder.file("part")};
  const auto refusal = [&] { return messageOf<std::exception>([&] { Evaluation(whole, {}); }); };
  const std::string verified = contentOf(folder.file("part/verified.csv"));
  std::filesystem::remove(folder.file("part/verified.csv"));
  EXPECT_EQ(refusal(),
            "merge: " + folder.file("part") + " holds no run that can be merged (no verified.csv)");
  setContent(folder.file("part/verified.csv"), verified);
  setContent(folder.file("part/run.yaml"), "");
  EXPECT_EQ(refusal(),
            "merge: " + folder.file("part") + "/run.yaml tells no settings, so that it may be of others");
}

// Something else than a file of rows has none, and is no reason to write over it.
TEST(VerifiedRun, WhatCannotBeReadIsNotTakenForNothing) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.file("out/frames.csv"));
  const std::string error = messageOf<std::exception>([&] { Evaluation(verifying(folder), {}); });
  EXPECT_NE(error.find(folder.file("out/frames.csv")), std::string::npos) << error;
  EXPECT_TRUE(std::filesystem::is_directory(folder.file("out/frames.csv")));
}

TEST(VerifiedRun, CountsTheEarlierOfTwoStampsOfOnePose) {
  const TemporaryFolder folder;
  EvaluationOptions options = verifying(folder);
  options.frame_rate = 10.0;
  options.stamp_start_ns = stampOf(0);
  Evaluation evaluation(options, {});
  for (const std::int64_t late_ns : {1000000, 0}) {
    for (std::size_t s = 0; s < 3; ++s)
      evaluation.addImage(s, stampOf(0) + late_ns, lit(late_ns == 0 ? 0 : 5, s));
    evaluation.waitForRoom(0);
  }
  evaluation.finish();
  const auto rows = rowsOf(folder.file("out/verified.csv"));
  ASSERT_EQ(rows.size(), 3u * 2u);
  for (const auto& row : rows) EXPECT_EQ(row[1], "500.000000000");
}

TEST(VerifiedRun, IsOfSiftAndOrbWhereTheyAreComparedUnlessToldOtherwise) {
  EvaluationOptions options;
  EXPECT_EQ(verifiedDetectors(options), (std::vector<std::string>{"sift", "orb"}));
  options.comparer.differences = {"brisk", "orb"};
  EXPECT_EQ(verifiedDetectors(options), std::vector<std::string>{"orb"});
  options.comparer.differences = {"boolean_rgb"};
  EXPECT_TRUE(verifiedDetectors(options).empty());
  options.comparer.differences = {"brisk", "orb"};
  options.verify = {"brisk"};
  EXPECT_EQ(verifiedDetectors(options), std::vector<std::string>{"brisk"});
  options.verify.emplace();
  EXPECT_TRUE(verifiedDetectors(options).empty());
}

TEST(VerifiedRun, RefusesWhatHasNoDetectorOrIsNotComparedNamingWhatCanBeHad) {
  const TemporaryFolder folder;
  EvaluationOptions options = verifying(folder);
  const auto refusal = [&] { return messageOf([&] { Evaluation(options, {}); }); };
  options.verify = {"boolean_rgb"};
  EXPECT_EQ(refusal().rfind("verify is [boolean_rgb], but must be a list of some of sift, ", 0), 0u)
      << refusal();
  options.comparer.differences = {"boolean_rgb", "orb", "brisk", "sift"};
  options.verify = {"sift", "akaze"};
  EXPECT_EQ(
      refusal(),
      "verify is [sift, akaze], but must be a list of some of [sift, orb, brisk], the detectors among the "
      "differences");
  options.comparer.differences = {"boolean_rgb"};
  EXPECT_EQ(refusal(),
            "verify is [sift, akaze], but must be [], since none of the differences has a detector");
  options = verifying(folder);
  options.verify = {"sift", "sift"};
  EXPECT_EQ(refusal().rfind("verify is [sift, sift], but must be a list of", 0), 0u) << refusal();
}

TEST(VerifiedRun, CountsWhatIsUndefinedInPicturesWithoutFeatures) {
  const TemporaryFolder folder;
  Evaluation evaluation(verifying(folder), {});
  for (std::int64_t pose = 0; pose < 3; ++pose) {
    for (std::size_t s = 0; s < 3; ++s)
      evaluation.addImage(s, stampOf(pose),
                          s == 0 ? lit(pose, 0) : cv::Mat(120, 150, CV_8UC3, cv::Scalar::all(9)));
  }
  EXPECT_TRUE(evaluation.finish().isWhole());
  const std::string summary = contentOf(folder.file("out/verified_summary.csv"));
  EXPECT_TRUE(hasLine(summary, "h12,h20,sift,repeatability,0,3,nan,nan,nan,nan")) << summary;
  EXPECT_TRUE(hasLine(summary, "h12,h20,sift,mma_3px,3,0,0,0,0,0"));       // no match is right
  EXPECT_TRUE(hasLine(summary, "h04,h12,orb,repeatability,3,0,0,0,0,0"));  // one has features
  EXPECT_TRUE(hasLine(summary, "h04,h12,orb,precision_3px,0,3,nan"));      // nothing is accepted
}

TEST(VerifiedRun, NamesPathAndLineOfWhatItCannotRead) {
  const TemporaryFolder folder;
  const EvaluationOptions options = verifying(folder);
  {
    Evaluation evaluation(options, {});
    feedLit(evaluation, 0, 2);
    evaluation.finish();
  }
  const std::string path = folder.file("out/verified.csv");
  const std::string good = contentOf(path);
  const auto refusalOf = [&](const std::string& was, const std::string& is) {
    std::string bad = good;
    setContent(path, bad.replace(bad.find(was), was.size(), is));
    return messageOf<std::runtime_error>([&] { Evaluation(options, {}); });
  };
  EXPECT_EQ(refusalOf("mma_10px", "mma_11px").rfind(path + ":1: was written by another version", 0), 0u);
  EXPECT_EQ(refusalOf("h12,sift", "h12,sfit"), path + ":2: the detector sfit is not one of this run");
  EXPECT_EQ(refusalOf("h12,orb", "h21,orb"), path + ":3: the pair h04, h21 is not one of this run");
  EXPECT_EQ(refusalOf("h12,sift,", "h12,sift,-").rfind(path + ":2: \"-", 0), 0u);
}

TEST(VerifiedRun, IsNotMixedWithOneThatVerifiesOthers) {
  const TemporaryFolder folder;
  EvaluationOptions options = verifying(folder);
  options.verify.emplace();
  {
    Evaluation evaluation(options, {});
    feedLit(evaluation, 0, 1);
    evaluation.finish();
  }
  options.verify.reset();
  const std::string refusal = messageOf([&] { Evaluation(options, {}); });
  EXPECT_NE(refusal.find("another setting: verify was [], now [sift, orb]"), std::string::npos) << refusal;
}

TEST(VerifiedRun, LeavesNothingInAFolderThatOneWithoutTakesOver) {
  const TemporaryFolder folder;
  EvaluationOptions options = verifying(folder);
  Evaluation(options, {}).finish();  // nothing came
  EXPECT_TRUE(std::filesystem::exists(folder.file("out/verified_summary.csv")));
  options.verify.emplace();
  Evaluation evaluation(options, {});
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/verified.csv")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/verified_summary.csv")));
}

/// Of seven poses the five sampled ones, 0, 2, 3, 5 and 6, and the two with the fewest and with the most
/// right matches, the lower ones of equals: by what verified.csv says.
std::vector<std::string> drawnBy(const std::string& folder) {
  std::map<std::string, std::vector<std::pair<double, std::string>>> right;
  for (const auto& row : rowsOf(folder + "/verified.csv"))
    right[row[2] + "-" + row[3] + "/" + row[4] + "/00000"].emplace_back(
        std::round(parseNumber(row[21]) * parseNumber(row[20])), row[0]);
  std::set<std::string> files;
  for (auto& [name, poses] : right) {
    std::vector<std::string> kept = {"0", "2", "3", "5", "6"};
    for (const double sign : {1.0, -1.0}) {
      std::sort(poses.begin(), poses.end(), [&](const auto& l, const auto& r) {
        return std::make_pair(sign * l.first, l.second) < std::make_pair(sign * r.first, r.second);
      });
      for (std::size_t i = 0; i < 2; ++i) kept.push_back(poses.at(i).second);
    }
    for (const std::string& pose : kept) files.insert(name + pose + ".png");
  }
  return {files.begin(), files.end()};
}

TEST(VerifiedRun, DrawsTheMatchesOfSampledAndOfExtremePosesWhereImagesAreKept) {
  for (const KeptImages images : {KeptImages::kNone, KeptImages::kSamples, KeptImages::kAll}) {
    const TemporaryFolder folder;
    EvaluationOptions options = verifying(folder);
    options.images = images;
    options.poses.count = kPoses;
    Evaluation evaluation(options, {});
    feedLit(evaluation, 0, kPoses);
    EXPECT_TRUE(evaluation.finish().isWhole());
    std::vector<std::string> found;
    const std::string matches = folder.file("out/matches");
    std::error_code none;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(matches, none))
      if (entry.is_regular_file()) found.push_back(entry.path().lexically_relative(matches).generic_string());
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, images == KeptImages::kNone ? std::vector<std::string>() : drawnBy(folder.file("out")));
  }
}

TEST(VerifiedRun, DrawsTheSameWhateverCameFirstAndHoweverOftenItWasKilled) {
  const TemporaryFolder folder;
  EvaluationOptions options = verifying(folder);
  options.poses.count = kPoses;
  options.is_whole_path = true;
  options.frame_rate = 10.0;
  options.stamp_start_ns = stampOf(0);
  for (const std::int64_t pose : {6, 1, 3}) {
    Evaluation evaluation(options, {});
    feedLit(evaluation, pose, pose + 1);
    evaluation.waitForRoom(0);
  }  // without finish(), as a killed process ends
  setContent(folder.file("out/matches/h04-h12/sift/000001.png"), "not there any more if it is none of them");
  Evaluation evaluation(options, {});
  for (const std::int64_t pose : {5, 0, 4, 2, 1, 3, 6}) feedLit(evaluation, pose, pose + 1);
  EXPECT_TRUE(evaluation.finish().isWhole());
  std::vector<std::string> found;
  const std::string matches = folder.file("out/matches");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(matches))
    if (entry.is_regular_file()) found.push_back(entry.path().lexically_relative(matches).generic_string());
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, drawnBy(folder.file("out")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/lost_features.bin"))) << "nobody will ask again";
}

// Their numbers turn round at the end, and of equally many right matches the earlier poses are drawn.
TEST(VerifiedRun, DrawsTheSameOfEqualImagesThatComeBackwards) {
  std::vector<std::vector<std::string>> found;
  for (const bool is_backwards : {false, true}) {
    const TemporaryFolder folder;
    std::string notes;
    Evaluation evaluation(verifying(folder), notingTo(&notes));
    for (std::int64_t i = 0; i < kPoses; ++i) {
      const std::int64_t pose = is_backwards ? kPoses - 1 - i : i;
      for (std::size_t s = 0; s < evaluation.options().streams.size(); ++s)
        evaluation.addImage(s, stampOf(pose), lit(0, s));
    }
    EXPECT_TRUE(evaluation.finish().isWhole());
    EXPECT_EQ(notes, "");
    found.emplace_back();
    const std::string matches = folder.file("out/matches");
    for (const auto& entry : std::filesystem::recursive_directory_iterator(matches))
      if (entry.is_regular_file())
        found.back().push_back(entry.path().lexically_relative(matches).generic_string());
    std::sort(found.back().begin(), found.back().end());
  }
  EXPECT_EQ(found[0].size(), 2u * 3u * 2u) << "the first two poses, pairs, detectors";
  EXPECT_EQ(found[1], found[0]);
}

TEST(VerifiedRun, SaysOfHowManyPosesWhereFeaturesAreLost) {
  const TemporaryFolder folder;
  EvaluationOptions options = verifying(folder);
  options.streams = {"h04", "h12", "self_test/h04"};
  options.pairs = {{"h04", "h12", 1}, {"h04", "self_test/h04", 1}};
  Evaluation evaluation(options, {});
  feedLit(evaluation, 0, kPoses);
  EXPECT_TRUE(evaluation.finish().isWhole());
  std::map<std::string, double> lost, right;
  for (const auto& row : rowsOf(folder.file("out/lost_features.csv"))) {
    EXPECT_EQ(row[1], "h12") << "a self-test loses nothing to be seen";
    EXPECT_EQ(row[3], "7");
    lost[row[2]] += parseNumber(row[6]) - parseNumber(row[7]);
  }
  for (const auto& row : rowsOf(folder.file("out/verified.csv"))) {
    if (row[3] == "h12") right[row[4]] += std::round(parseNumber(row[21]) * parseNumber(row[20]));
  }
  EXPECT_EQ(lost, right) << "of each detector: features that are not lost are right matches";
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/matches/h04-self_test")));
}

}  // namespace
}  // namespace sunlit::evaluate
