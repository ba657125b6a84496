#include <gtest/gtest.h>

#include <filesystem>

#include "sunlit/evaluate/same_place.h"
#include "sunlit/quantity/angle.h"
#include "unit/evaluate/run/small_evaluation.h"

namespace sunlit::evaluate {
namespace {

/// At x, looking so far to the left.
Told<Eigen::Isometry3d> stoodAt(double x_m, double left_deg = 0.0) {
  Eigen::Isometry3d map_from_optical = Eigen::Isometry3d::Identity();
  map_from_optical.translate(Eigen::Vector3d(x_m, 2.0, 1.0));
  map_from_optical.rotate(Eigen::AngleAxisd(left_deg * kRadPerDeg, Eigen::Vector3d::UnitZ()));
  return told(map_from_optical);
}

/// Two recordings: their stamps coincide at pose 1, the second of them is of `other`.
Outcome ofTwoRecordings(const TemporaryFolder& folder, const Told<Eigen::Isometry3d>& other, bool is_late) {
  EvaluationOptions options = optionsFor(folder);
  options.pairs = {{"h04", "h12", 1}, {"h04", "h04", 1}};
  options.poses.count = 3;
  Evaluation evaluation(options, {});
  for (std::int64_t pose = 0; pose < 3; ++pose) {
    evaluation.addTruePose(stampOf(pose), stoodAt(0.0));
    if (pose == 1 && !is_late) evaluation.addTruePose(stampOf(pose), other);
    feedPose(evaluation, pose);
  }
  evaluation.waitForRoom(0);
  if (is_late) evaluation.addTruePose(stampOf(1), other);
  EXPECT_TRUE(evaluation.isComplete());
  return evaluation.finish();
}

TEST(OnePlace, ImagesOfOneStampButTwoPlacesAreNotComparedWheneverThatIsKnown) {
  for (const bool is_late : {false, true}) {
    const TemporaryFolder folder;
    const Outcome outcome = ofTwoRecordings(folder, stoodAt(2.5, 10.0), is_late);
    EXPECT_FALSE(outcome.isWhole());
    EXPECT_EQ(outcome.counts.pairs[0].two_places, 1u) << is_late;
    EXPECT_EQ(outcome.counts.pairs[0].evaluated, 2u) << is_late;
    EXPECT_EQ(outcome.counts.pairs[1].two_places, 0u) << "a stream is where it is itself";
    EXPECT_EQ(outcome.counts.pairs[1].evaluated, 3u) << is_late;
    const std::string frames = contentOf(folder.file("out/frames.csv"));
    EXPECT_FALSE(hasLine(frames, "1,500.100000000,h04,h12,")) << frames;
    EXPECT_TRUE(hasLine(frames, "1,500.100000000,h04,h04,")) << frames;
    const std::string problems = contentOf(folder.file("out/problems.csv"));
    EXPECT_TRUE(hasLine(problems,
                        "two_places,1,500.100000000,h04-h12,two poses of this stamp are 2.5 m and 10 deg "
                        "apart: are these two recordings?"))
        << problems;
    EXPECT_NE(contentOf(folder.file("out/run.yaml")).find("two_places: 1}"), std::string::npos);
  }
}

/// path.csv of three poses of which that of stamp 1 has two places, in one of the orders in which they come.
std::string pathOfTwoPlaces(const TemporaryFolder& folder, bool is_image_first, bool is_late,
                            std::string* notes) {
  const EvaluationCallbacks callbacks = notingTo(notes);
  Evaluation evaluation(optionsFor(folder), callbacks);
  const auto stand = [&](std::int64_t pose, double x) {
    evaluation.addPlace({stampOf(pose), x, 2.0, 1.0, 90.0});
    evaluation.addTruePose(stampOf(pose), stoodAt(x));
  };
  for (std::int64_t pose = 0; pose < 3; ++pose) {
    if (is_image_first) feedPose(evaluation, pose);
    stand(pose, static_cast<double>(pose));
    if (pose == 1 && !is_late) stand(pose, 51.0);
    if (!is_image_first) feedPose(evaluation, pose);
  }
  if (is_late) stand(1, 51.0);
  stand(1, 1.0);
  evaluation.finish();
  return contentOf(folder.file("out/path.csv"));
}

TEST(OnePlace, IsWhatPathsAreMadeOfInWhateverOrderPosesAndImagesCome) {
  for (const bool is_image_first : {false, true}) {
    for (const bool is_late : {false, true}) {
      const TemporaryFolder folder;
      std::string notes;
      EXPECT_EQ(pathOfTwoPlaces(folder, is_image_first, is_late, &notes),
                "pose,stamp,x,y,z,yaw_deg\n0,500.000000000,0,2,1,90\n2,500.200000000,2,2,1,90\n")
          << is_image_first << is_late;
      EXPECT_NE(notes.find("/path.csv: 1 poses of stamps of two places left out\n"), std::string::npos);
    }
  }
}

TEST(OnePlace, LeavesNoPathWhereThereIsNone) {
  const TemporaryFolder folder;
  {
    Evaluation killed(optionsFor(folder), {});
    feedPose(killed, 0);
    for (const double x : {0.0, 2.5}) {
      killed.addPlace({stampOf(0), x, 2.0, 1.0, 90.0});
      killed.addTruePose(stampOf(0), stoodAt(x));
    }
    killed.waitForRoom(0);
  }
  ASSERT_TRUE(hasLine(contentOf(folder.file("out/path.csv")), "0,500.000000000,0,2,1,90"));
  Evaluation evaluation(optionsFor(folder), {});
  feedPose(evaluation, 1);
  evaluation.finish();
  EXPECT_FALSE(std::filesystem::exists(folder.file("out/path.csv")));
}

TEST(OnePlace, IsToldAgainWhereTheRunThatFoundItWasKilled) {
  const TemporaryFolder folder;
  {
    Evaluation killed(optionsFor(folder), {});
    feedPose(killed, 0);
    killed.addTruePose(stampOf(0), stoodAt(0.0));
    killed.waitForRoom(0);
    killed.addTruePose(stampOf(0), stoodAt(2.5));
  }
  ASSERT_TRUE(hasLine(contentOf(folder.file("out/frames.csv")), "0,500.000000000,h04,h12,"));
  Evaluation evaluation(optionsFor(folder), {});
  evaluation.addTruePose(stampOf(0), stoodAt(0.0));
  feedPose(evaluation, 0);
  evaluation.waitForRoom(0);
  evaluation.addTruePose(stampOf(0), stoodAt(2.5));
  const Outcome outcome = evaluation.finish();
  EXPECT_EQ(outcome.counts.pairs[0].resumed, 0u);
  EXPECT_EQ(outcome.counts.pairs[0].two_places, 1u);
  EXPECT_FALSE(hasLine(contentOf(folder.file("out/frames.csv")), "0,500.000000000,h04,h12,"));
  EXPECT_TRUE(hasLine(contentOf(folder.file("out/problems.csv")), "two_places,0,500.000000000,h04-h12,"));
}

// Two recordings of one path, at the same stamps: one in July, one in December.
TEST(OnePlace, ImagesOfOneStampButTwoSkiesAreNotCompared) {
  const TemporaryFolder folder;
  const auto capture = [](std::int64_t pose, const std::string& utc, double illuminance_lx) {
    CaptureRecord record;
    record.pose = pose;
    record.stamp_ns = stampOf(pose);
    record.scene_illuminance_lx = illuminance_lx;
    record.utc_text = utc;
    return record;
  };
  const std::string july = "2024-07-01T09:00:00.000Z", december = "2024-12-01T09:00:00.000Z";
  Evaluation evaluation(optionsFor(folder), {});
  for (std::int64_t pose = 0; pose < 4; ++pose) {
    evaluation.addCapture(1, capture(pose, july, 81000.0));
    feedPose(evaluation, pose);
  }
  evaluation.waitForRoom(0);
  evaluation.addCapture(1, capture(0, july, 81000.0));  // rendered again
  evaluation.addCapture(1, capture(1, december, 15000.0));
  evaluation.addCapture(1, capture(2, july, 80000.0));
  const Outcome outcome = evaluation.finish();
  EXPECT_FALSE(outcome.isWhole());
  EXPECT_EQ(outcome.counts.pairs[0].two_places, 2u);
  EXPECT_EQ(outcome.counts.pairs[0].evaluated, 2u);
  const std::string problems = contentOf(folder.file("out/problems.csv"));
  for (const std::string& line :
       {"two_places,1,500.100000000,h04-h12,two captures of h12 at this stamp tell of skies of " + july +
            " and " + december + ": are these two recordings?",
        std::string("two_places,2,500.200000000,h04-h12,two captures of h12 at this stamp tell of 81000 and "
                    "80000 lx: are these two recordings?")})
    EXPECT_TRUE(hasLine(problems, line)) << problems;
  const std::string captures = contentOf(folder.file("out/captures.csv"));
  EXPECT_NE(captures.find(",81000,"), std::string::npos);
  EXPECT_EQ(captures.find(",15000,"), std::string::npos) << "the first counts, as of images";
}

TEST(OnePlace, IsForgottenWhereNoImageComesForLong) {
  const TemporaryFolder folder;
  Evaluation evaluation(optionsFor(folder), {});
  feedPose(evaluation, 1);
  for (std::int64_t pose = 0; pose < 66000; ++pose) evaluation.addTruePose(stampOf(pose), stoodAt(0.0));
  for (std::int64_t pose = 0; pose < 2; ++pose) evaluation.addTruePose(stampOf(pose), stoodAt(2.5));
  feedPose(evaluation, 0);
  const Outcome outcome = evaluation.finish();
  EXPECT_EQ(outcome.counts.pairs[0].two_places, 1u) << "of the image that came before";
  EXPECT_EQ(outcome.counts.pairs[0].evaluated, 1u);
}

TEST(OnePlace, IsTheSameWithinWhatHardlyMovesAPixel) {
  const auto two_places = [](const Told<Eigen::Isometry3d>& other) {
    const TemporaryFolder folder;
    return ofTwoRecordings(folder, other, false).counts.pairs[0].two_places;
  };
  EXPECT_EQ(two_places(stoodAt(0.0)), 0u) << "sent twice";
  EXPECT_EQ(two_places(stoodAt(0.009, 0.09)), 0u);
  EXPECT_EQ(two_places(stoodAt(0.011)), 1u);
  EXPECT_EQ(two_places(stoodAt(0.0, 0.11)), 1u);
}

TEST(TwoPlaces, AreToldByHowFarApartTheyAre) {
  const Eigen::Isometry3d here = stoodAt(0.0).value;
  EXPECT_EQ(twoPlaces(here, here), "");
  EXPECT_EQ(twoPlaces(stoodAt(2.5, 10.0).value, here),
            "two poses of this stamp are 2.5 m and 10 deg apart: are these two recordings?");
}

}  // namespace
}  // namespace sunlit::evaluate
