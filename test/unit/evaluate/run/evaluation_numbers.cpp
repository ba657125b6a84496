// Poses whose number neither a frame rate nor a capture tells: those of runs that were cut off, too.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <iterator>

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

void tell(Evaluation& evaluation, std::int64_t stamp, std::int64_t pose) {
  CaptureRecord capture;
  capture.pose = pose;
  capture.stamp_ns = stampOf(stamp);
  for (std::size_t s = 0; s < evaluation.options().streams.size(); ++s) evaluation.addCapture(s, capture);
}

TEST(PosesByCapture, AreNamedWhereOneStampHasTwoOfThem) {
  const TemporaryFolder folder;
  Evaluation evaluation(tenPoses(folder), {});
  for (std::int64_t pose = 0; pose < kPoses; ++pose) {
    tell(evaluation, pose, pose);
    feedPose(evaluation, pose);
  }
  CaptureRecord other;
  other.pose = 7;
  other.stamp_ns = stampOf(3);
  evaluation.addCapture(1, other);
  evaluation.finish();
  const std::string problems = contentOf(folder.file("out/problems.csv"));
  EXPECT_TRUE(hasLine(problems, "two_numbers,7,500.300000000," + evaluation.options().streams[1] +
                                    ",an earlier capture of this stamp tells pose 3; the last one counts"))
      << problems;
}

/// All of a stamp, which is evaluated before anything else comes.
void evaluateStamp(Evaluation& evaluation, std::int64_t stamp) {
  PlaceRecord place;
  place.stamp_ns = stampOf(stamp);
  place.x_m = static_cast<double>(stamp);
  evaluation.addPlace(place);
  feedPose(evaluation, stamp);
  evaluation.waitForRoom(0);
}

EvaluationOptions unlimited(const TemporaryFolder& folder) {
  EvaluationOptions options = tenPoses(folder);
  options.poses.count = 0;
  return options;
}

// As of a bag that begins amid a path, and whose first captures are missing.
TEST(PosesBeforeTheFirstCapture, AreUnplacedWhereNoCaptureTellsThem) {
  const TemporaryFolder folder;
  std::string notes;
  const EvaluationCallbacks callbacks = notingTo(&notes);
  Evaluation evaluation(unlimited(folder), callbacks);
  for (std::int64_t stamp = 0; stamp < 6; ++stamp) {
    evaluateStamp(evaluation, stamp);
    if (stamp >= 2) tell(evaluation, stamp, 248 + stamp);
  }
  const Outcome outcome = evaluation.finish();
  EXPECT_FALSE(outcome.isWhole());
  EXPECT_EQ(outcome.counts.completed_poses, 4u);
  for (const PairCounts& pair : outcome.counts.pairs) {
    EXPECT_EQ(pair.evaluated, 4u);
    EXPECT_EQ(pair.unplaced, 2u);
  }
  EXPECT_EQ(outcome.summary[0].statistics.n, 4u);
  const std::string frames = contentOf(folder.file("out/frames.csv"));
  EXPECT_TRUE(hasLine(frames, "250,500.200000000,h04,h12,")) << frames;
  for (const char* invented : {"0,", "1,"}) EXPECT_FALSE(hasLine(frames, invented)) << frames;
  const std::string problems = contentOf(folder.file("out/problems.csv"));
  for (const char* stamp : {"500.000000000", "500.100000000"})
    EXPECT_TRUE(hasLine(problems, std::string("unplaced,,") + stamp +
                                      ",h04-h12,no capture of this stamp says which pose it is\n"))
        << problems;
  const std::string path = contentOf(folder.file("out/path.csv"));
  EXPECT_EQ(path.rfind("pose,stamp,x,y,z,yaw_deg\n250,500.200000000,2,", 0), 0u) << path;
  EXPECT_NE(
      notes.find("/path.csv: 2 poses of stamps of which no capture says which pose they are left out\n"),
      std::string::npos)
      << notes;
  EXPECT_EQ(notes.find("without an image"), std::string::npos) << notes;
  const auto pictures = std::filesystem::directory_iterator(folder.file("out/images/h12"));
  EXPECT_EQ(std::distance(begin(pictures), end(pictures)), 4);
}

// By order the first two were 0 and 1, which are poses of stamps that come later.
TEST(PosesBeforeTheFirstCapture, AreThoseOfTheirOwnCapturesAndTakeNoOthers) {
  const TemporaryFolder folder;
  Evaluation backwards(tenPoses(folder), {});
  for (const std::int64_t stamp : {0, 1}) evaluateStamp(backwards, stamp);
  for (const std::int64_t stamp : {0, 1}) tell(backwards, stamp, kPoses - 1 - stamp);
  for (std::int64_t stamp = 2; stamp < kPoses; ++stamp) {
    EXPECT_FALSE(backwards.isComplete()) << stamp;
    EXPECT_EQ(backwards.counts().passed_poses, static_cast<std::size_t>(stamp));
    tell(backwards, stamp, kPoses - 1 - stamp);
    evaluateStamp(backwards, stamp);
  }
  EXPECT_TRUE(backwards.isComplete());
  const Outcome outcome = backwards.finish();
  EXPECT_TRUE(outcome.isWhole()) << contentOf(folder.file("out/problems.csv"));
  EXPECT_EQ(outcome.counts.pairs[0].evaluated, 10u);
  const std::string frames = contentOf(folder.file("out/frames.csv"));
  const std::string path = contentOf(folder.file("out/path.csv"));
  filesOfUndisturbedRun(folder);
  for (std::int64_t pose = 0; pose < kPoses; ++pose) {
    const std::int64_t stamp = kPoses - 1 - pose;
    const std::string line = std::to_string(pose) + ",500." + std::to_string(stamp) + "00000000,";
    EXPECT_TRUE(hasLine(frames, line + "h04,h12,")) << line << "\n" << frames;
    EXPECT_TRUE(hasLine(path, line + std::to_string(stamp) + ",")) << line << "\n" << path;
    const auto pictureOf = [&](const std::string& out, std::int64_t number) {
      return contentOf(folder.file(out) + "/images/h12/00000" + std::to_string(number) + ".png");
    };
    EXPECT_EQ(pictureOf("out", pose), pictureOf("undisturbed", stamp)) << pose;
  }
}

TEST(PosesBeforeTheFirstCapture, AreAbsentUnderTheNumbersThatOnlyOrderGave) {
  const TemporaryFolder folder;
  Evaluation evaluation(tenPoses(folder), {});
  evaluateStamp(evaluation, 0);
  evaluateStamp(evaluation, 1);
  for (std::int64_t stamp = 2; stamp < 6; ++stamp) {
    tell(evaluation, stamp, 4 + stamp);
    evaluateStamp(evaluation, stamp);
  }
  const Outcome outcome = evaluation.finish();
  EXPECT_EQ(outcome.absent_poses, 6u);
  EXPECT_TRUE(hasLine(contentOf(folder.file("out/problems.csv")), "absent,0,,"));
}

// A loop, whose last pose is its first again: the capture of the first stamp comes when that has come, too.
TEST(PosesBeforeTheFirstCapture, CountBeforeALaterStampOfTheirPose) {
  const TemporaryFolder folder;
  Evaluation evaluation(unlimited(folder), {});
  evaluateStamp(evaluation, 0);
  for (const std::int64_t stamp : {1, 2}) {
    tell(evaluation, stamp, stamp == 1 ? 8 : 7);
    evaluateStamp(evaluation, stamp);
  }
  tell(evaluation, 0, 7);
  const Outcome outcome = evaluation.finish();
  for (const PairCounts& pair : outcome.counts.pairs) {
    EXPECT_EQ(pair.evaluated, 2u);
    EXPECT_EQ(pair.duplicate, 1u);
  }
  EXPECT_EQ(outcome.counts.completed_poses, 2u);
  const std::string frames = contentOf(folder.file("out/frames.csv"));
  EXPECT_TRUE(hasLine(frames, "7,500.000000000,h04,h12,")) << frames;
  EXPECT_FALSE(hasLine(frames, "7,500.200000000,")) << frames;
  const std::string problems = contentOf(folder.file("out/problems.csv"));
  EXPECT_TRUE(hasLine(problems, "duplicate,7,500.200000000,h04-h12,")) << problems;
}

// The run before ended without a capture, and this one has other stamps.
TEST(PosesBeforeTheFirstCapture, GiveWayToThoseThatCapturesTellARunThatGoesOn) {
  const TemporaryFolder folder;
  {
    Evaluation killed(unlimited(folder), {});
    evaluateStamp(killed, 0);
  }
  Evaluation evaluation(unlimited(folder), {});
  for (const std::int64_t stamp : {5, 6}) {
    tell(evaluation, stamp, stamp - 5);
    evaluateStamp(evaluation, stamp);
  }
  const Outcome outcome = evaluation.finish();
  for (const PairCounts& pair : outcome.counts.pairs) {
    EXPECT_EQ(pair.evaluated, 2u);
    EXPECT_EQ(pair.resumed, 0u);
    EXPECT_EQ(pair.unplaced, 1u);
  }
  const std::string frames = contentOf(folder.file("out/frames.csv"));
  EXPECT_TRUE(hasLine(frames, "0,500.500000000,h04,h12,")) << frames;
  EXPECT_FALSE(hasLine(frames, "0,500.000000000,")) << frames;
}

// One of a publisher's own clock, of a camera that nobody compares, or of an image that was lost.
TEST(CapturesOfNoImage, TellNothingOfAnyOther) {
  for (const bool is_first : {true, false}) {
    const TemporaryFolder folder;
    std::string notes;
    const EvaluationCallbacks callbacks = notingTo(&notes);
    {
      Evaluation evaluation(tenPoses(folder), callbacks);
      if (is_first) tell(evaluation, 77, 5);
      for (std::int64_t pose = 0; pose < 4; ++pose) evaluateStamp(evaluation, pose);
      if (!is_first) tell(evaluation, 77, 5);
      for (std::int64_t pose = 4; pose < kPoses; ++pose) evaluateStamp(evaluation, pose);
      EXPECT_TRUE(evaluation.isComplete());
      const Outcome outcome = evaluation.finish();
      EXPECT_TRUE(outcome.isWhole()) << contentOf(folder.file("out/problems.csv"));
      EXPECT_EQ(outcome.counts.pairs[0].evaluated, 10u);
    }
    EXPECT_NE(notes.find("/captures.csv: 1 stamps, none of them that of an image: poses are numbered by the "
                         "order of their images\n"),
              std::string::npos)
        << notes;
    const std::vector<std::string> files = filesOf(folder.file("out"));
    EXPECT_EQ(files, filesOfUndisturbedRun(folder));
    // Taken up, nothing is missing and nothing changes.
    Evaluation again(tenPoses(folder), {});
    EXPECT_TRUE(again.isComplete());
    const Outcome outcome = again.finish();
    EXPECT_TRUE(outcome.isWhole());
    EXPECT_EQ(outcome.counts.pairs[0].resumed, 10u);
    EXPECT_EQ(filesOf(folder.file("out")), files);
  }
}

// Nobody knows its sun, but it says which pose it is of: none that came.
TEST(CapturesOfNoImage, ArePlacesOfNoneWhereTheyCannotBeUsed) {
  const TemporaryFolder folder;
  CaptureRecord capture;
  capture.pose = 5;
  capture.stamp_ns = stampOf(77);
  capture.utc_text = "yesterday";
  for (int run = 0; run < 2; ++run) {
    Evaluation evaluation(tenPoses(folder), {});
    if (run == 0) {
      evaluation.addCapture(0, capture);
      for (std::int64_t pose = 0; pose < kPoses; ++pose) evaluateStamp(evaluation, pose);
    }
    const Outcome outcome = evaluation.finish();
    EXPECT_TRUE(outcome.isWhole());
    EXPECT_EQ(outcome.counts.pairs[0].evaluated + outcome.counts.pairs[0].resumed, 10u) << run;
    const std::string frames = contentOf(folder.file("out/frames.csv"));
    EXPECT_TRUE(hasLine(frames, "9,500.900000000,h04,h12,")) << frames;
    EXPECT_TRUE(hasLine(contentOf(folder.file("out/problems.csv")), "unusable,5,507.700000000,h04,"));
  }
}

// The capture of an image comes before it, as live, and that of one numbered by order after it.
TEST(CapturesOfNoImage, CountAsSoonAsTheirImageComes) {
  const TemporaryFolder folder;
  Evaluation evaluation(unlimited(folder), {});
  evaluateStamp(evaluation, 0);
  tell(evaluation, 1, 21);
  tell(evaluation, 2, 22);
  EXPECT_EQ(evaluation.counts().completed_poses, 1u);  // by order still
  evaluateStamp(evaluation, 1);
  tell(evaluation, 0, 20);
  evaluateStamp(evaluation, 2);
  const Outcome outcome = evaluation.finish();
  EXPECT_TRUE(outcome.isWhole()) << contentOf(folder.file("out/problems.csv"));
  EXPECT_EQ(outcome.counts.completed_poses, 3u);
  const std::string frames = contentOf(folder.file("out/frames.csv"));
  for (const char* line :
       {"20,500.000000000,h04,h12,", "21,500.100000000,h04,h12,", "22,500.200000000,h04,h12,"})
    EXPECT_TRUE(hasLine(frames, line)) << frames;
}

// Which was recorded at another time, and tells no poses either.
TEST(PosesByOrder, OfAnotherDriveInTheSameFolderAreToldOf) {
  const TemporaryFolder folder;
  std::string notes;
  const EvaluationCallbacks callbacks = notingTo(&notes);
  const auto run = [&](const std::vector<std::int64_t>& stamps) {
    notes.clear();
    Evaluation evaluation(unlimited(folder), callbacks);
    for (const std::int64_t stamp : stamps) evaluateStamp(evaluation, stamp);
    evaluation.finish();
    return notes;
  };
  const std::string told =
      ": taken for more of that drive. Where it is another one, choose another output_dir";
  EXPECT_EQ(run({1, 2, 3}).find(told), std::string::npos) << notes;
  EXPECT_EQ(run({1, 2, 3, 4}).find(told), std::string::npos) << notes;  // more of it
  EXPECT_NE(run({700, 701})
                .find("/out holds a drive of stamps from 500.100000000 to 500.400000000, and the first image "
                      "is of 570.000000000" +
                      told),
            std::string::npos)
      << notes;
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
