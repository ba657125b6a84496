// Queries of a run looked for in the map of the same run.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <utility>

#include "sunlit/evaluate/differences/feature_difference.h"
#include "sunlit/evaluate/localise/localisation.h"
#include "sunlit/evaluate/run/run_folder.h"
#include "support/message_of.h"
#include "support/moody_detector.h"
#include "support/textured_scene.h"
#include "unit/evaluate/run/small_evaluation.h"

namespace sunlit::evaluate {
namespace {

const image::PinholeCamera kCamera{200, 150, 173.0, 173.0, 99.5, 74.5};
const ViewCamera kBent({200, 150, 125.0, 125.0, 98.0, 75.0},
                       {image::LensModel::kPlumbBob, {-0.28, 0.07, 0, 0}});
constexpr std::int64_t kPoses = 4;
const std::vector<std::string> kStreams = {"noon", "dusk", "night"};

std::vector<PosedView> driveBy(const ViewCamera& camera) {
  std::vector<PosedView> all;
  for (std::int64_t p = 0; p < kPoses; ++p)
    all.push_back(corridor().seenFrom(lookingAlongX({0.5 * static_cast<double>(p), 0, 0}), camera));
  return all;
}

const ViewCamera kFisheye({200, 200, 62.0, 62.0, 99.0, 100.0},
                          {image::LensModel::kEquidistant, {0.0035, 0.0007, -0.002, 0.0002}});

/// All of what follows is seen through it, while it lives.
class ThroughLens {
 public:
  explicit ThroughLens(const ViewCamera& camera = kBent) : drive_(driveBy(camera)) { drive = &drive_; }
  ~ThroughLens() { drive = nullptr; }
  static inline const std::vector<PosedView>* drive = nullptr;

 private:
  std::vector<PosedView> drive_;
};

/// A drive along the corridor, half a metre a pose.
const PosedView& viewOf(std::int64_t pose) {
  static const std::vector<PosedView> straight = driveBy(kCamera);
  return (ThroughLens::drive ? *ThroughLens::drive : straight).at(static_cast<std::size_t>(pose));
}

/// Stream 0 is the map; the others are darker.
cv::Mat lit(std::int64_t pose, std::size_t stream) {
  cv::Mat rgb;
  viewOf(pose).picture.rgb.convertTo(rgb, CV_8U, 1.0 - 0.3 * static_cast<double>(stream));
  return rgb;
}

EvaluationOptions localising(const TemporaryFolder& folder) {
  EvaluationOptions options;
  options.streams = kStreams;
  options.output_dir = folder.file("out");
  options.comparer.differences = {"boolean_rgb", "sift", "orb"};
  options.poses.count = kPoses;
  options.is_whole_path = true;
  options.localisation.map = "noon";
  options.localisation.map_every_m = 1.0;
  return options;
}

void feedTruth(Evaluation& evaluation, std::int64_t pose) {
  evaluation.addTruePose(stampOf(pose), told(viewOf(pose).map_from_optical));
  evaluation.addDepth(stampOf(pose), told(viewOf(pose).depth));
}

/// pictureOf(pose, stream) of the first `streams`.
template <typename PictureOf>
void feedImages(Evaluation& evaluation, std::int64_t pose, std::size_t streams, const PictureOf& pictureOf) {
  for (std::size_t s = 0; s < streams; ++s) {
    evaluation.addCamera(s, stampOf(pose), told(viewOf(pose).camera));
    evaluation.addImage(s, stampOf(pose), pictureOf(pose, s));
  }
}

void feedImages(Evaluation& evaluation, std::int64_t pose) {
  feedImages(evaluation, pose, 3, lit);
}

PosedView litView(std::int64_t pose, std::size_t stream) {
  PosedView view = viewOf(pose);
  view.picture = makePicture(lit(pose, stream));
  return view;
}

/// What Localisation makes of the same pictures, as files; the first streams are the map.
std::string expectedRows(Retrieval retrieval = Retrieval::kTruth, std::size_t map_streams = 1) {
  LocalisationOptions options;
  options.localiser.retrieval = retrieval;
  options.map_every_m = 1.0;
  Localisation localisation(options);
  for (std::size_t s = 0; s < map_streams; ++s) localisation.addKeyFrames({litView(0, s), litView(2, s)});
  localisation.finishMap();
  std::vector<LocalisationRow> rows;
  for (std::size_t s = map_streams; s < kStreams.size(); ++s) {
    for (std::int64_t pose = 0; pose < kPoses; ++pose) {
      const PosedView view = litView(pose, s);
      const auto results = localisation.localise({view}).results[0];
      for (std::size_t d = 0; d < results.size(); ++d) {
        LocalisationRow row;
        row.pose = static_cast<std::size_t>(pose);
        row.stamp_ns = stampOf(pose);
        row.map = map_streams == 1 ? "noon" : "noon+dusk";
        row.query = kStreams[s];
        row.detector = options.detectors[d];
        row.result = results[d];
        row.truth = view.map_from_optical;
        rows.push_back(row);
      }
    }
  }
  const TemporaryFolder folder;
  writeLocalisation(folder.file("rows"), rows);
  return contentOf(folder.file("rows"));
}

/// Truth and images of the poses from `first` up to `end`.
void feed(Evaluation& evaluation, std::int64_t first, std::int64_t end) {
  for (std::int64_t pose = first; pose < end; ++pose) {
    feedTruth(evaluation, pose);
    feedImages(evaluation, pose);
  }
}

LocalisationOutcome finishAndLocalise(Evaluation& evaluation) {
  EXPECT_TRUE(evaluation.finish().isWhole());
  return evaluation.localise({});
}

TEST(EvaluationLocalise, GivesWhatThePicturesThemselvesGive) {
  const std::string expected = expectedRows();
  for (const int threads : {1, 4}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(threads));
    const TemporaryFolder folder;
    Evaluation evaluation(localising(folder), {});
    feed(evaluation, 0, kPoses);
    const LocalisationOutcome outcome = finishAndLocalise(evaluation);
    EXPECT_TRUE(outcome.isWhole());
    EXPECT_EQ(outcome.key_frames, 2u);
    EXPECT_EQ(outcome.queries, 2u * 2u * static_cast<std::size_t>(kPoses));
    EXPECT_EQ(outcome.summary.size(), 4u);
    EXPECT_EQ(outcome.summary[0].failures, 0u);
    EXPECT_EQ(contentOf(folder.file("out/localisation.csv")), expected);
    EXPECT_FALSE(std::filesystem::exists(folder.file("out/observations.bin"))) << "nobody will ask again";
  }
}

// What a run localises is what is localised of its pictures by themselves.
void expectTheSame() {
  const TemporaryFolder folder;
  Evaluation evaluation(localising(folder), {});
  feed(evaluation, 0, kPoses);
  const LocalisationOutcome outcome = finishAndLocalise(evaluation);
  EXPECT_EQ(outcome.summary.at(0).failures, 0u);
  EXPECT_EQ(contentOf(folder.file("out/localisation.csv")), expectedRows());
}

TEST(EvaluationLocalise, GivesTheSameThroughALens) {
  const ThroughLens lens;
  expectTheSame();
}

// Beyond 140 degrees across, where a pinhole's pixels tell no more where the lens looks.
TEST(EvaluationLocalise, GivesTheSameThroughAFisheye) {
  const ThroughLens lens(kFisheye);
  expectTheSame();
}

TEST(EvaluationLocalise, FindsKeyFramesByTheirMatchesAlike) {
  const TemporaryFolder folder;
  EvaluationOptions options = localising(folder);
  options.localisation.localiser.retrieval = Retrieval::kAll;
  Evaluation evaluation(options, {});
  feed(evaluation, 0, kPoses);
  EXPECT_TRUE(finishAndLocalise(evaluation).isWhole());
  EXPECT_EQ(contentOf(folder.file("out/localisation.csv")), expectedRows(Retrieval::kAll));
}

TEST(EvaluationLocalise, AMapMayBeMadeOfSeveralStreams) {
  const TemporaryFolder folder;
  EvaluationOptions options = localising(folder);
  options.localisation.map = "noon+dusk";
  Evaluation evaluation(options, {});
  feed(evaluation, 0, kPoses);
  EXPECT_TRUE(evaluation.finish().isWhole());
  std::set<std::pair<std::string, std::int64_t>> named;
  LocaliseCallbacks callbacks;
  callbacks.found = [&](const LocalisationRow& row) {
    named.emplace(row.key_frame.stream, row.key_frame.pose);
  };
  EXPECT_EQ(evaluation.localise(callbacks).key_frames, 4u);
  EXPECT_EQ(contentOf(folder.file("out/localisation.csv")), expectedRows(Retrieval::kTruth, 2));
  const std::set<std::pair<std::string, std::int64_t>> there = {
      {"noon", 0}, {"noon", 2}, {"dusk", 0}, {"dusk", 2}};
  EXPECT_GT(named.size(), 1u);
  for (const auto& one : named) EXPECT_EQ(there.count(one), 1u) << one.first << " " << one.second;
}

TEST(EvaluationLocalise, ImagesWaitForTheirDepth) {
  const TemporaryFolder folder;
  Evaluation evaluation(localising(folder), {});
  for (std::int64_t pose = 0; pose < kPoses; ++pose) feedImages(evaluation, pose);
  EXPECT_EQ(evaluation.counts().completed_poses, 0u);
  EXPECT_EQ(evaluation.counts().waiting_images, 3u * static_cast<std::size_t>(kPoses));
  EXPECT_TRUE(evaluation.counts().awaits_truth);
  for (std::int64_t pose = kPoses; pose-- > 0;) feedTruth(evaluation, pose);
  EXPECT_TRUE(finishAndLocalise(evaluation).isWhole());
  EXPECT_EQ(contentOf(folder.file("out/localisation.csv")), expectedRows());
}

/// What a run of all poses writes, where `feedOf` gives a stream's image and camera of a pose.
struct Localised {
  LocalisationOutcome outcome;
  std::string rows, problems;
};
Localised localisedBy(
    const std::function<void(Evaluation& evaluation, std::size_t stream, std::int64_t pose)>& feedOf) {
  const TemporaryFolder folder;
  Evaluation evaluation(localising(folder), {});
  for (std::int64_t pose = 0; pose < kPoses; ++pose) {
    feedTruth(evaluation, pose);
    for (std::size_t s = 0; s < 3; ++s) feedOf(evaluation, s, pose);
  }
  evaluation.waitForRoom(0);
  evaluation.finish();
  const LocalisationOutcome outcome = evaluation.localise({});
  return {outcome, contentOf(folder.file("out/localisation.csv")),
          contentOf(folder.file("out/problems.csv"))};
}

TEST(EvaluationLocalise, TakesTheCameraOfEachImagesOwnStampWhicheverComesFirst) {
  // Another lens from pose 2 on.
  const auto camera = [](std::int64_t pose) { return told(pose < 2 ? viewOf(pose).camera : kBent); };
  const auto in_order = [&](bool is_image_first) {
    return localisedBy([&](Evaluation& evaluation, std::size_t s, std::int64_t pose) {
      if (!is_image_first) evaluation.addCamera(s, stampOf(pose), camera(pose));
      evaluation.addImage(s, stampOf(pose), lit(pose, s));
      if (is_image_first) evaluation.addCamera(s, stampOf(pose), camera(pose));
    });
  };
  const Localised camera_first = in_order(false), image_first = in_order(true);
  EXPECT_EQ(image_first.rows, camera_first.rows);
  EXPECT_NE(image_first.rows, expectedRows());
  EXPECT_EQ(image_first.problems, camera_first.problems);
}

TEST(EvaluationLocalise, OneWithoutACameraOfItsStampIsNamedAndNoOther) {
  for (const bool is_there : {false, true}) {
    const Localised found = localisedBy([&](Evaluation& evaluation, std::size_t s, std::int64_t pose) {
      evaluation.addImage(s, stampOf(pose), lit(pose, s));
      const bool is_bad = s == 2 && pose == 1;
      if (is_bad && is_there) evaluation.addCamera(s, stampOf(pose), unusable<ViewCamera>("fx is 0"));
      if (!is_bad) evaluation.addCamera(s, stampOf(pose), told(viewOf(pose).camera));
    });
    EXPECT_EQ(found.outcome.unobserved, 1u);
    const std::string fault =
        is_there ? "camera/camera_info: fx is 0" : "no camera/camera_info of this stamp";
    EXPECT_EQ(found.problems,
              "kind,pose,stamp,where,reason\nunlocalised,1,500.100000000,night," + fault + "\n");
  }
}

TEST(EvaluationLocalise, OneCameraAloneIsThatOfAllImages) {
  const Localised found = localisedBy([&](Evaluation& evaluation, std::size_t s, std::int64_t pose) {
    // Twice, as a sender does that latches it, where a reader connects again.
    for (int i = 0; i < (pose % 2 == 0 ? 2 : 0); ++i) evaluation.addCamera(s, 0, told(viewOf(pose).camera));
    evaluation.addImage(s, stampOf(pose), lit(pose, s));
    if (pose < 3 || s < 2) return;
    evaluation.waitForRoom(0);
    EXPECT_EQ(evaluation.counts().completed_poses, 4u) << "they do not wait for the end";
  });
  EXPECT_TRUE(found.outcome.isWhole());
  EXPECT_EQ(found.rows, expectedRows());
}

TEST(EvaluationLocalise, ABrokenOffRunIsTakenUpAgain) {
  const TemporaryFolder folder;
  {
    Evaluation evaluation(localising(folder), {});
    feed(evaluation, 0, 2);
    evaluation.waitForRoom(0);
  }
  // Torn in the midst of a record, as by a kill.
  std::ofstream(folder.file("out/observations.bin"), std::ios::app) << "snltebs1";
  std::string notes;
  const EvaluationCallbacks callbacks = notingTo(&notes);
  Evaluation evaluation(localising(folder), callbacks);
  EXPECT_NE(notes.find("observations.bin: 8 bytes of a torn end were left out"), std::string::npos) << notes;
  EXPECT_EQ(evaluation.counts().completed_poses, 2u);
  feed(evaluation, 2, kPoses);
  EXPECT_TRUE(finishAndLocalise(evaluation).isWhole());
  EXPECT_EQ(contentOf(folder.file("out/localisation.csv")), expectedRows());
  evaluation.compareMethods();
  const std::string compared = contentOf(folder.file("out/comparisons.csv"));
  EXPECT_TRUE(hasLine(compared, "error_m,methods,dusk in noon,sift,orb,4,0,0,0,")) << compared;
  EXPECT_TRUE(hasLine(compared, "within_0.25m_2deg,hours,orb,dusk in noon,night in noon,4,0,0,0,"))
      << compared;
  EXPECT_TRUE(hasLine(compared, "d,hours,boolean_rgb,noon-dusk,dusk-night,4,0,0,0,")) << compared;
  EXPECT_TRUE(hasLine(compared, "precision_3px,methods,noon-dusk,sift,orb,4,0,0,0,")) << compared;
  // Once more, when all is there: it stays.
  Evaluation again(localising(folder), {});
  EXPECT_TRUE(again.isComplete());
  const LocalisationOutcome outcome = finishAndLocalise(again);
  EXPECT_FALSE(outcome.is_asked);
  writeLocalisationSummary(folder.file("told.csv"), outcome.summary);
  EXPECT_EQ(contentOf(folder.file("told.csv")), contentOf(folder.file("out/localisation_summary.csv")))
      << "and is told of again";
  EXPECT_EQ(outcome.summary.size(), 4u);
  EXPECT_EQ(contentOf(folder.file("out/localisation.csv")), expectedRows());
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/observations.bin"))) << "nor is an empty file left";
  again.compareMethods();
  EXPECT_EQ(contentOf(folder.file("out/comparisons.csv")), compared)
      << "queries by what localisation.csv says";
  EXPECT_THROW(again.compareMethods(StopToken([] { return true; })), Stopped);
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/comparisons.csv"))) << "never half of it";
}

// What was made of fewer poses does not stand beside the summary of all.
TEST(EvaluationLocalise, ABrokenOffRunLeavesNoResultsOfAnEarlierEnd) {
  const TemporaryFolder folder;
  EvaluationOptions options = localising(folder);
  {
    Evaluation evaluation(options, {});
    feed(evaluation, 0, 3);
    EXPECT_FALSE(evaluation.finish().isWhole());
    EXPECT_GT(evaluation.localise({}).key_frames, 0u);
    evaluation.compareMethods();
  }
  const std::vector<std::string> results = {"localisation.csv", "localisation_poses.csv",
                                            "localisation_summary.csv", "comparisons.csv"};
  for (const std::string& name : results) EXPECT_TRUE(std::filesystem::exists(folder.file("out/" + name)));
  {
    Evaluation evaluation(options, {});
    feed(evaluation, 3, kPoses);
    evaluation.waitForRoom(0);
    evaluation.finish(StopToken([] { return true; }));
  }
  for (const std::string& name : results)
    EXPECT_FALSE(std::filesystem::exists(folder.file("out/" + name))) << name;
  Evaluation again(options, {});
  EXPECT_TRUE(finishAndLocalise(again).isWhole());
  EXPECT_EQ(contentOf(folder.file("out/localisation.csv")), expectedRows());
}

// A whole run has forgotten what it observed: a longer one would be localised in a map of its new poses
// alone.
TEST(EvaluationLocalise, AWholeRunDoesNotGrow) {
  const TemporaryFolder folder;
  EvaluationOptions options = localising(folder);
  options.comparer.differences = {"boolean_rgb", "orb"};
  options.verify.emplace();
  options.poses.count = 2;
  {
    Evaluation evaluation(options, {});
    feed(evaluation, 0, 2);
    EXPECT_TRUE(finishAndLocalise(evaluation).isWhole());
  }
  options.poses.count = kPoses;
  const std::string ended = contentOf(folder.file("out/run.yaml"));
  const std::string refusal =
      "output_dir " + folder.file("out") +
      " holds a run of 2 poses that has ended, of whose features sums alone were kept, so "
      "that it cannot grow to 4: choose another output_dir, or poses: 2";
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { Evaluation(options, {}); }), refusal);
  EXPECT_EQ(contentOf(folder.file("out/run.yaml")), ended);
  options.poses.count = 2;
  {
    Evaluation again(options, {});  // and is killed: what it began anew is empty
    EXPECT_TRUE(again.isComplete());
  }
  options.poses.count = kPoses;
  EXPECT_EQ(messageOf<std::invalid_argument>([&] { Evaluation(options, {}); }), refusal);
}

// The first begins where a whole path does.
TEST(EvaluationLocalise, SharesOfAPathAreLocalisedTogether) {
  const TemporaryFolder folder;
  EvaluationOptions options = localising(folder);
  options.is_whole_path = false;
  options.poses.count = 2;
  for (const auto& [name, first] :
       std::vector<std::pair<std::string, std::int64_t>>{{"start", 0}, {"end", 2}}) {
    options.output_dir = folder.file(name);
    options.poses.first = first;
    Evaluation share(options, {});
    feed(share, first, first + 2);
    EXPECT_TRUE(finishAndLocalise(share).isWhole());
  }
  EvaluationOptions merging = localising(folder);
  merging.merge = {folder.file("start"), folder.file("end")};
  Evaluation merged(merging, {});
  EXPECT_TRUE(merged.isComplete());
  EXPECT_TRUE(finishAndLocalise(merged).isWhole());
  EXPECT_EQ(contentOf(folder.file("out/localisation.csv")), expectedRows());
  EXPECT_TRUE(hasLine(contentOf(folder.file("out/lost_features.csv")), "noon,dusk,sift,4,"))
      << contentOf(folder.file("out/lost_features.csv"));
  // Nobody can localise more with what has none of it.
  merging.merge = {folder.file("out")};
  merging.output_dir = folder.file("again");
  EXPECT_EQ(
      messageOf<std::invalid_argument>([&] { Evaluation(merging, {}); }),
      "merge: " + folder.file("out") +
          " keeps no observations.bin, so that its poses cannot be localised with others: merge the runs "
          "that it was merged of, or evaluate them in another folder without whole_path");
  EXPECT_FALSE(std::filesystem::exists(folder.file("again/run.yaml")));
}

// Another tool may have left one in the same folder.
TEST(EvaluationLocalise, RowsOfOthersAreNotTakenForThisRuns) {
  const TemporaryFolder folder;
  EvaluationOptions options = localising(folder);
  std::filesystem::create_directories(options.output_dir);
  writeLocalisation(folder.file("out/localisation.csv"), {});
  Evaluation evaluation(options, {});
  for (std::int64_t pose = 0; pose < kPoses; ++pose) feedImages(evaluation, pose);
  const LocalisationOutcome outcome = finishAndLocalise(evaluation);
  EXPECT_TRUE(outcome.is_asked);
  EXPECT_FALSE(outcome.isWhole());
}

TEST(EvaluationLocalise, RowsOfOtherMapsDetectorsAndTimesAreNotTakenForThisRuns) {
  const TemporaryFolder folder;
  const EvaluationOptions options = localising(folder);
  const auto isAskedAgain = [&] {
    Evaluation evaluation(options, {});
    if (!evaluation.isComplete()) feed(evaluation, 0, kPoses);
    return finishAndLocalise(evaluation).is_asked;
  };
  EXPECT_TRUE(isAskedAgain());
  const std::string file = folder.file("out/localisation.csv");
  const std::vector<LocalisationRow> ours = loadLocalisation(file);
  EXPECT_FALSE(isAskedAgain());
  const auto isAskedAfter = [&](const std::function<void(LocalisationRow&)>& change) {
    std::vector<LocalisationRow> rows = ours;
    for (LocalisationRow& row : rows) change(row);
    writeLocalisation(file, rows);
    return isAskedAgain();
  };
  EXPECT_FALSE(isAskedAfter([](LocalisationRow&) {}));
  EXPECT_TRUE(isAskedAfter([](LocalisationRow& row) { row.map = "dawn"; }));
  EXPECT_TRUE(isAskedAfter([](LocalisationRow& row) { row.detector = "sift"; }));
  EXPECT_TRUE(isAskedAfter([](LocalisationRow& row) { row.stamp_ns += kFrameNs / 2; }));
}

// Nobody else writes what would be taken for this run's.
TEST(EvaluationLocalise, AFolderWithARunIsNoPlaceForOthers) {
  const TemporaryFolder folder;
  EXPECT_EQ(messageOf<std::exception>([&] { requireNoRun(folder.file("out")); }), "") << "is not there";
  const EvaluationOptions options = localising(folder);
  Evaluation(options, {}).finish();  // nothing came
  EXPECT_EQ(messageOf<std::exception>([&] { requireNoRun(folder.file("out")); }), "");
  Evaluation evaluation(options, {});
  feed(evaluation, 0, 1);
  evaluation.finish();
  EXPECT_EQ(
      messageOf<std::invalid_argument>([&] { requireNoRun(folder.file("out")); }),
      folder.file("out") +
          ": this folder holds the results of an evaluation (run.yaml), which would be mixed with those "
          "of others; choose another");
}

TEST(EvaluationLocalise, AMapWhoseDepthTellsNoPlaceIsAFaultAndNotOfTheLight) {
  const TemporaryFolder folder;
  Evaluation evaluation(localising(folder), {});
  for (std::int64_t pose = 0; pose < kPoses; ++pose) {
    feedImages(evaluation, pose);
    evaluation.addTruePose(stampOf(pose), told(viewOf(pose).map_from_optical));
    evaluation.addDepth(stampOf(pose), told(cv::Mat(150, 200, CV_32FC1, cv::Scalar(0))));
  }
  const LocalisationOutcome outcome = finishAndLocalise(evaluation);
  EXPECT_GT(outcome.key_frames, 0u);
  EXPECT_EQ(outcome.unplaced, (std::vector<std::string>{"sift", "orb"}));
  EXPECT_FALSE(outcome.isWhole());
  const std::string run = contentOf(folder.file("out/run.yaml"));
  EXPECT_NE(run.find("\n  unplaced: ['sift', 'orb']\n"), std::string::npos) << run;
}

TEST(EvaluationLocalise, WhatIsMissingIsNamedAndCounted) {
  const TemporaryFolder folder;
  std::string notes;
  Evaluation evaluation(localising(folder), notingTo(&notes));
  for (std::int64_t pose = 0; pose < kPoses; ++pose) feedImages(evaluation, pose);
  feedTruth(evaluation, 0);
  evaluation.addTruePose(stampOf(1), unusable<Eigen::Isometry3d>("holds what is not finite"));
  evaluation.addDepth(stampOf(1), told(viewOf(1).depth));
  evaluation.addTruePose(stampOf(2), told(viewOf(2).map_from_optical));
  evaluation.addDepth(stampOf(2), told(cv::Mat(10, 10, CV_32FC1, cv::Scalar(1))));
  evaluation.addTruePose(stampOf(3), told(viewOf(3).map_from_optical));
  const Outcome whole = evaluation.finish();
  EXPECT_TRUE(whole.isWhole()) << "the differences need none of it";
  EXPECT_EQ(whole.counts.streams[0].unlocalised, 3u);
  EXPECT_EQ(whole.counts.streams[1].unlocalised, 1u) << "a query needs no depth";
  EXPECT_NE(contentOf(folder.file("out/run.yaml")).find("unlocalised: 3}"), std::string::npos);
  const LocalisationOutcome outcome = evaluation.localise({});
  EXPECT_EQ(outcome.key_frames, 1u);
  EXPECT_EQ(outcome.unobserved, 2u) << "pose 1 of both queries";
  EXPECT_EQ(outcome.unmapped, 3u);
  EXPECT_NE(notes.find("map: 3 of its pictures were none to choose key frames from"), std::string::npos);
  EXPECT_NE(contentOf(folder.file("out/run.yaml"))
                .find("\n  key_frames: 1\n  not_mapped: 3\n  not_localised: 2\n  unplaced: []\n"),
            std::string::npos);
  EXPECT_FALSE(outcome.isWhole());
  const std::string problems = contentOf(folder.file("out/problems.csv"));
  EXPECT_TRUE(hasLine(problems, "unlocalised,1,500.100000000,dusk,camera/pose: holds what is not finite"));
  EXPECT_TRUE(hasLine(problems, "unlocalised,3,500.300000000,noon,no camera/depth/image_raw of this stamp"));
  EXPECT_NE(problems.find("unlocalised,2,500.200000000,noon,\"is 200x150 px, but its depth 10x10 px\""),
            std::string::npos)
      << problems;
}

TEST(EvaluationLocalise, PicturesOfTwoPlacesAreNeitherKeyFrameNorQuery) {
  for (const bool is_late : {false, true}) {
    const TemporaryFolder folder;
    Evaluation evaluation(localising(folder), {});
    const auto other = [&] { evaluation.addTruePose(stampOf(2), told(viewOf(3).map_from_optical)); };
    for (std::int64_t pose = 0; pose < kPoses; ++pose) {
      feedTruth(evaluation, pose);
      if (pose == 2 && !is_late) other();
      feedImages(evaluation, pose);
    }
    evaluation.waitForRoom(0);
    if (is_late) other();
    const Outcome outcome = evaluation.finish();
    for (const PairCounts& pair : outcome.counts.pairs) EXPECT_EQ(pair.two_places, 1u);
    const LocalisationOutcome localised = evaluation.localise({});
    EXPECT_EQ(localised.queries, 12u) << "3 poses of 2 streams by 2 detectors";
    const std::string rows = contentOf(folder.file("out/localisation.csv"));
    EXPECT_FALSE(hasLine(rows, "2,500.200000000,")) << rows;
  }
}

/// A run in which the sun of dusk is set at pose 2, or is not; its captures come with the images, or late.
LocalisationOutcome setMeanwhile(const TemporaryFolder& folder, bool is_set, bool is_late) {
  Evaluation evaluation(localising(folder), {});
  const auto tell = [&](std::int64_t pose) {
    CaptureRecord capture;
    capture.pose = pose;
    capture.stamp_ns = stampOf(pose);
    capture.utc = Instant().plusSeconds(is_set && pose == 2 ? 3600.0 : 0.0);
    evaluation.addCapture(1, capture);
  };
  for (std::int64_t pose = 0; pose < kPoses; ++pose) {
    if (!is_late) tell(pose);
    feedTruth(evaluation, pose);
    // Under another sun nothing is as it should be.
    feedImages(evaluation, pose, 3, [&](std::int64_t p, std::size_t s) {
      return is_set && p == 2 && s == 1 ? cv::Mat(cv::Mat::zeros(lit(p, s).size(), CV_8UC3)) : lit(p, s);
    });
  }
  evaluation.waitForRoom(0);
  for (std::int64_t pose = 0; is_late && pose < kPoses; ++pose) tell(pose);
  EXPECT_EQ(evaluation.finish().isWhole(), !is_set);
  return evaluation.localise({});
}

TEST(EvaluationLocalise, PicturesUnderAnotherSunAreNoQueriesUntilTheSameRunEvaluatesThem) {
  for (const bool is_late : {false, true}) {
    const TemporaryFolder folder;
    const LocalisationOutcome outcome = setMeanwhile(folder, true, is_late);
    EXPECT_TRUE(outcome.isWhole());
    EXPECT_EQ(outcome.queries, 14u) << "4 poses of one stream and 3 of another by 2 detectors";
    EXPECT_EQ(contentOf(folder.file("out/localisation.csv")).find("2,500.200000000,noon,dusk,"),
              std::string::npos);
    EXPECT_EQ(setMeanwhile(folder, false, is_late).queries, 16u);
    EXPECT_EQ(contentOf(folder.file("out/localisation.csv")), expectedRows()) << is_late;
  }
}

TEST(EvaluationLocalise, SaysWhatIsLeftOutSinceItIsNotCompared) {
  const TemporaryFolder folder;
  EvaluationOptions options = localising(folder);
  options.streams = {"noon", "dusk", "night", "dawn"};
  options.pairs = {{"noon", "dusk", 2}, {"noon", "night"}};
  options.frame_rate = 10.0;
  options.stamp_start_ns = stampOf(0);
  std::vector<std::string> notes;
  EvaluationCallbacks callbacks;
  callbacks.note = [&](const std::string& line) { notes.push_back(line); };
  Evaluation evaluation(options, callbacks);
  EXPECT_EQ(notes, (std::vector<std::string>{
                       "dusk: looked for at the poses of its pairs alone: every 2 of noon-dusk",
                       "dawn: not looked for in the map, since it is in no pair"}));
  feed(evaluation, 0, kPoses);
  const LocalisationOutcome outcome = finishAndLocalise(evaluation);
  EXPECT_TRUE(outcome.isWhole());
  std::vector<std::size_t> found;
  for (const LocalisationSummary& summary : outcome.summary) found.push_back(summary.n);
  EXPECT_EQ(found, (std::vector<std::size_t>{2, 2, 4, 4})) << "of dusk and night, by SIFT and ORB";
}

/// At all poses, with their truth.
template <typename PictureOf>
void feedPictures(Evaluation& evaluation, std::size_t streams, const PictureOf& pictureOf) {
  for (std::int64_t pose = 0; pose < kPoses; ++pose) {
    feedTruth(evaluation, pose);
    feedImages(evaluation, pose, streams, pictureOf);
    evaluation.waitForRoom(0);
  }
}

TEST(EvaluationLocalise, SaysOfWhichStreamNothingWasEvaluated) {
  const TemporaryFolder folder;
  Evaluation evaluation(localising(folder), {});
  feedPictures(evaluation, 2, lit);
  evaluation.finish();
  const LocalisationOutcome outcome = evaluation.localise({});
  EXPECT_EQ(outcome.key_frames, 2u);
  EXPECT_EQ(outcome.uncompared, std::vector<std::string>{"night"});
  EXPECT_FALSE(outcome.isWhole());
}

/// Rows of one query stream by one detector.
std::size_t rowsOf(const LocalisationOutcome& outcome, const std::string& query,
                   const std::string& detector) {
  for (const LocalisationSummary& summary : outcome.summary) {
    if (summary.query == query && summary.detector == detector) return summary.n;
  }
  return 0;
}

/// With a detector that throws at marked pictures.
EvaluationOptions moody(const TemporaryFolder& folder) {
  EvaluationOptions options = localising(folder);
  options.comparer.known.add("moody", makeFeatureDifference(moodyDetector()));
  options.comparer.differences = {"boolean_rgb", "moody", "orb"};
  options.localisation.detectors = std::vector<std::string>{"moody", "orb"};
  return options;
}

TEST(EvaluationLocalise, APictureThatADetectorThrowsAtCostsItsOwnPairsAlone) {
  const TemporaryFolder folder;
  Evaluation evaluation(moody(folder), {});
  feedPictures(evaluation, 3, [](std::int64_t pose, std::size_t s) {
    const bool is_marked = static_cast<std::int64_t>(s) == pose && s < 2;
    return is_marked ? marked(lit(pose, s)) : lit(pose, s);
  });
  const Outcome whole = evaluation.finish();
  EXPECT_FALSE(whole.isWhole());
  std::vector<std::size_t> evaluated, failed, unlocalised;
  for (const PairCounts& pair : whole.counts.pairs) {
    evaluated.push_back(pair.evaluated);
    failed.push_back(pair.failed);
  }
  for (const StreamCounts& stream : whole.counts.streams) unlocalised.push_back(stream.unlocalised);
  EXPECT_EQ(failed, (std::vector<std::size_t>{2, 1, 1})) << "noon-dusk, noon-night, dusk-night";
  EXPECT_EQ(evaluated, (std::vector<std::size_t>{2, 3, 3}));
  EXPECT_EQ(unlocalised, (std::vector<std::size_t>{1, 1, 0}));
  const std::string problems = contentOf(folder.file("out/problems.csv"));
  for (const char* line : {"failed,0,500.000000000,noon-dusk,", "failed,0,500.000000000,noon-night,",
                           "unlocalised,0,500.000000000,noon,moody: ", "failed,1,500.100000000,noon-dusk,",
                           "failed,1,500.100000000,dusk-night,", "unlocalised,1,500.100000000,dusk,moody: "})
    EXPECT_TRUE(hasLine(problems, line + std::string(kMood))) << line << "\n" << problems;
  const LocalisationOutcome outcome = evaluation.localise({});
  EXPECT_EQ(outcome.key_frames, 2u);
  EXPECT_EQ(rowsOf(outcome, "dusk", "moody"), 3u);
  EXPECT_EQ(rowsOf(outcome, "dusk", "orb"), 4u) << "what the other detector finds there is kept";
  EXPECT_EQ(rowsOf(outcome, "night", "moody"), 4u) << "and what is found in the others";
  EXPECT_EQ(rowsOf(outcome, "night", "orb"), 4u);
}

TEST(EvaluationLocalise, EachDetectorThatThrowsAtAPictureIsNamed) {
  const TemporaryFolder folder;
  EvaluationOptions options = moody(folder);
  options.comparer.known.add("gloomy", makeFeatureDifference(moodyDetector()));
  options.comparer.differences = {"moody", "gloomy", "orb"};
  options.localisation.detectors = options.comparer.differences;
  Evaluation evaluation(options, {});
  feedPictures(evaluation, 3, [](std::int64_t pose, std::size_t s) { return marked(lit(pose, s)); });
  EXPECT_FALSE(evaluation.finish().isWhole());
  const std::string problems = contentOf(folder.file("out/problems.csv"));
  const std::string both = "moody: " + std::string(kMood) + "; gloomy: " + kMood;
  EXPECT_TRUE(hasLine(problems, "unlocalised,0,500.000000000,noon," + both)) << problems;
}

TEST(EvaluationLocalise, ADetectorThatThrowsAtAllPicturesLeavesNoStreamOut) {
  const TemporaryFolder folder;
  Evaluation evaluation(moody(folder), {});
  feedPictures(evaluation, 3, [](std::int64_t pose, std::size_t s) { return marked(lit(pose, s)); });
  EXPECT_FALSE(evaluation.finish().isWhole());
  const LocalisationOutcome outcome = evaluation.localise({});
  EXPECT_EQ(rowsOf(outcome, "night", "orb"), 4u);
  EXPECT_EQ(rowsOf(outcome, "night", "moody"), 0u);
  EXPECT_TRUE(outcome.uncompared.empty()) << outcome.uncompared.front();
}

TEST(EvaluationLocalise, WithoutAKeyFrameNothingIsClaimed) {
  const TemporaryFolder folder;
  Evaluation evaluation(localising(folder), {});
  for (std::int64_t pose = 0; pose < kPoses; ++pose) feedImages(evaluation, pose);
  evaluation.finish();
  const LocalisationOutcome outcome = evaluation.localise({});
  EXPECT_EQ(outcome.key_frames, 0u);
  EXPECT_FALSE(outcome.isWhole());
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/localisation.csv")));
}

TEST(EvaluationLocalise, DepthWithoutImagesStaysWithinTheMemory) {
  const TemporaryFolder folder;
  EvaluationOptions options = localising(folder);
  options.poses.count = 0;
  options.frame_rate = 10.0;
  options.memory_limit_bytes = 1000000;
  Evaluation evaluation(options, {});
  for (std::int64_t pose = 0; pose < 100; ++pose)
    evaluation.addDepth(stampOf(pose), told(cv::Mat(150, 200, CV_32FC1, cv::Scalar(1))));
  EXPECT_LE(evaluation.counts().bytes, options.memory_limit_bytes);
}

TEST(EvaluationLocalise, PosesWithoutImagesCountAndTurnNoImageAway) {
  const TemporaryFolder folder;
  EvaluationOptions options = localising(folder);
  options.memory_limit_bytes = 1000000;  // of a few images, or of about 5000 poses
  Evaluation evaluation(options, {});
  for (std::int64_t before = 9000; before > 0; --before) {
    evaluation.addTruePose(stampOf(-before), told(viewOf(0).map_from_optical));
    EXPECT_GT(evaluation.counts().bytes, 0u);
    EXPECT_LE(evaluation.counts().bytes, options.memory_limit_bytes);
  }
  for (std::int64_t pose = 0; pose < kPoses; ++pose) {
    feedImages(evaluation, pose);
    feedTruth(evaluation, pose);
    evaluation.waitForRoom(0);
  }
  for (const StreamCounts& stream : evaluation.finish().counts.streams) {
    EXPECT_EQ(stream.dropped, 0u);
    EXPECT_EQ(stream.unlocalised, 0u);
  }
}

TEST(EvaluationLocalise, ComparesWithoutItWhereWhatItIsLocalisedByNeverComes) {
  const TemporaryFolder folder;
  EvaluationOptions options = localising(folder);
  options.comparer.differences = {"boolean_rgb", "orb"};
  options.verify.emplace();
  options.images = KeptImages::kNone;
  options.poses.count = 20;
  options.memory_limit_bytes = std::size_t{8} * 3 * 200 * 150 * 3;
  Evaluation evaluation(options, {});
  for (std::int64_t pose = 0; pose < 20; ++pose) {
    for (std::size_t s = 0; s < 3; ++s) evaluation.addImage(s, stampOf(pose), lit(pose % kPoses, s));
    EXPECT_LE(evaluation.counts().bytes, options.memory_limit_bytes);
    evaluation.waitForRoom(0);  // as a bag does
  }
  EXPECT_EQ(evaluation.counts().waiting_images, 3u * (4u + 1u)) << "in half of the memory, and the newest";
  const Outcome outcome = evaluation.finish();
  for (const PairCounts& pair : outcome.counts.pairs) EXPECT_EQ(pair.evaluated, 20u);
  for (const StreamCounts& stream : outcome.counts.streams) {
    EXPECT_EQ(stream.dropped, 0u);
    EXPECT_EQ(stream.unlocalised, 20u);
  }
  EXPECT_TRUE(outcome.isWhole());
  EXPECT_FALSE(evaluation.localise({}).isWhole());
}

TEST(EvaluationLocalise, NothingIsAskedOfARunThatDoesNotLocalise) {
  const TemporaryFolder folder;
  EvaluationOptions options = localising(folder);
  options.comparer.differences = {"boolean_rgb"};
  EXPECT_NE(messageOf([&] { Evaluation(options, {}); }).find("localisation/detectors is []"),
            std::string::npos);
  options.localisation.map = "";
  Evaluation evaluation(options, {});
  for (std::int64_t pose = 0; pose < kPoses; ++pose) feedImages(evaluation, pose);
  EXPECT_FALSE(finishAndLocalise(evaluation).is_asked);
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/observations.bin")));
}

TEST(EvaluationLocalise, AsksForStreamsAndDetectorsThatThereAre) {
  const TemporaryFolder folder;
  EvaluationOptions options = localising(folder);
  options.localisation.map = "morning";
  EXPECT_NE(messageOf([&] { Evaluation(options, {}); }).find("localisation/map is \"morning\""),
            std::string::npos);
  options.localisation.map = "noon+noon";
  EXPECT_NE(messageOf([&] { Evaluation(options, {}); }).find("localisation/map is \"noon+noon\""),
            std::string::npos);
  options.localisation.map = "noon+dusk+night";
  EXPECT_NE(messageOf([&] { Evaluation(options, {}); }).find("one is left to be looked for"),
            std::string::npos);
  options = localising(folder);
  options.localisation.queries = {"noon"};
  EXPECT_NE(messageOf([&] { Evaluation(options, {}); }).find("localisation/queries"), std::string::npos);
  // Features are found of what is compared.
  options = localising(folder);
  options.pairs = {{"dusk", "night"}};
  EXPECT_EQ(
      messageOf([&] { Evaluation(options, {}); }),
      "localisation/map is \"noon\", but must be of streams that are in pairs, and noon is in none: add "
      "one of it to pairs");
  options.pairs = {{"noon", "dusk"}};
  options.localisation.queries = {"dusk", "night"};
  EXPECT_EQ(
      messageOf([&] { Evaluation(options, {}); }),
      "localisation/queries is [dusk, night], but must be of streams that are in pairs, and night is in "
      "none: add one of it to pairs");
  options.localisation.map = "noon+dusk";
  options.localisation.queries.clear();
  EXPECT_NE(messageOf([&] { Evaluation(options, {}); }).find("one is left to be looked for"),
            std::string::npos);
  options = localising(folder);
  options.localisation.detectors = std::vector<std::string>{"brisk"};
  EXPECT_NE(messageOf([&] { Evaluation(options, {}); }).find("localisation/detectors is [brisk]"),
            std::string::npos);
}

}  // namespace
}  // namespace sunlit::evaluate
