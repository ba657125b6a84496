#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include "sunlit/evaluate/run/one_sun.h"
#include "support/message_of.h"
#include "unit/evaluate/run/small_evaluation.h"

namespace sunlit::evaluate {
namespace {

constexpr double kHour_s = 3600.0;
const std::string kWasSet = ": was the sun set meanwhile (set_date_time)?";

/// Under the sky of so many seconds after some noon.
CaptureRecord captureAt(std::int64_t pose, double after_noon_s) {
  CaptureRecord capture;
  capture.pose = pose;
  capture.stamp_ns = stampOf(pose);
  capture.utc = Instant().plusNanoseconds(std::llround(after_noon_s * 1e3) * 1000000);  // as it is sent
  capture.utc_text = "noon+" + std::to_string(std::llround(after_noon_s));
  return capture;
}

/// Poses of those of another sun, where that of each pose shows so many seconds after noon.
std::vector<std::int64_t> otherSunsOf(std::int64_t poses,
                                      const std::function<double(std::int64_t)>& clock_s) {
  Suns suns;
  std::vector<std::int64_t> others;
  const auto note = [&](const std::vector<OtherSun>& found) {
    for (const OtherSun& other : found) others.push_back((other.stamp_ns - stampOf(0)) / kFrameNs);
  };
  for (std::int64_t pose = 0; pose < poses; ++pose) note(suns.add("h12", captureAt(pose, clock_s(pose))));
  note(suns.finish("h12"));
  return others;
}

using Poses = std::vector<std::int64_t>;

TEST(OneSun, IsThatOfTheFirstCaptureWheneverItIsSet) {
  const auto is_set_at = [](std::int64_t first, std::int64_t last) {
    return otherSunsOf(40,
                       [=](std::int64_t pose) { return pose >= first && pose <= last ? -3 * kHour_s : 0.0; });
  };
  EXPECT_EQ(is_set_at(40, 40), Poses());
  EXPECT_EQ(is_set_at(30, 32), (Poses{30, 31, 32})) << "and set back";
  EXPECT_EQ(is_set_at(39, 39), (Poses{39})) << "the last";
  EXPECT_EQ(is_set_at(3, 4), (Poses{3, 4}));
  EXPECT_EQ(is_set_at(3, 3), (Poses{3}));
  EXPECT_EQ(is_set_at(1, 1), (Poses{1}));
  EXPECT_EQ(is_set_at(1, 39).size(), 39u);
}

TEST(OneSun, MovesAlongAtAnyRate) {
  for (const double rate : {0.0, 0.001, 0.013, 1.0, 15.0, 600.0, -600.0, 86400.0, 1e7}) {
    const auto clock = [&](std::int64_t pose) { return rate * 0.1 * static_cast<double>(pose); };
    EXPECT_EQ(otherSunsOf(2000, clock), Poses()) << rate;
    for (const std::int64_t first : {3, 1500}) {
      const auto set = [&](std::int64_t pose) { return clock(pose) + (pose >= first ? 5 * kHour_s : 0.0); };
      EXPECT_EQ(otherSunsOf(first + 2, set), (Poses{first, first + 1})) << rate;
    }
  }
}

TEST(OneSun, MayBeOfAClockThatBeginsWithItsFirstSubscriber) {
  for (const double begins : {0.4, 1.0, 5.7}) {
    const auto clock = [&](std::int64_t pose) {
      return 60.0 * std::max(0.0, static_cast<double>(pose) - begins);
    };
    EXPECT_EQ(otherSunsOf(30, clock), Poses()) << begins;
  }
  const auto set_running = [](std::int64_t pose) {
    return pose < 20 ? 0.0 : 60.0 * static_cast<double>(pose - 19);
  };
  EXPECT_EQ(otherSunsOf(23, set_running), (Poses{20, 21, 22})) << "not after seconds";
}

TEST(OneSun, OfTwoCapturesAloneNobodyCanTell) {
  EXPECT_EQ(otherSunsOf(2, [](std::int64_t pose) { return kHour_s * static_cast<double>(pose); }), Poses());
}

TEST(OneSun, IsToldByWhatWasExpectedAndSeen) {
  OneSun moving;
  std::vector<OtherSun> others;
  for (std::int64_t pose = 0; pose < 4; ++pose)
    others = moving.add(captureAt(pose, 60.0 * static_cast<double>(pose) + (pose == 3 ? kHour_s : 0.0)));
  ASSERT_EQ(others.size(), 1u);
  EXPECT_EQ(others[0].fault,
            "its sky is of noon+3780, not of noon+0 + 180 s as by the first capture" + kWasSet);
}

/// Poses of those of another site, where each sees the sun so many seconds after noon at an azimuth.
Poses otherSitesOf(std::int64_t poses, const std::function<double(std::int64_t)>& clock_s,
                   const std::function<double(std::int64_t)>& azimuth_deg) {
  OneSite site;
  Poses others;
  for (std::int64_t pose = 0; pose < poses; ++pose) {
    CaptureRecord capture = captureAt(pose, clock_s(pose));
    capture.sun_azimuth_deg = azimuth_deg(pose);
    capture.sun_elevation_deg = 30.0;
    if (!site.faultOf(capture).empty()) others.push_back(pose);
  }
  return others;
}

// As where set_site is called, from pose 10 up to 12.
TEST(OneSun, IsSeenFromOneSite) {
  for (const double rate : {0.0, 1.0, 600.0, -600.0}) {
    const auto clock = [=](std::int64_t pose) { return rate * 0.1 * static_cast<double>(pose); };
    const auto turned = [=](std::int64_t pose) { return 180.0 + clock(pose) / 240.0; };
    const auto moved = [=](double by_deg) {
      return otherSitesOf(20, clock, [=](std::int64_t pose) {
        return turned(pose) + (pose >= 10 && pose < 12 ? by_deg : 0.0);
      });
    };
    EXPECT_EQ(moved(0.0), Poses()) << rate;
    EXPECT_EQ(moved(40.0), (Poses{10, 11})) << rate;
    EXPECT_EQ(moved(-2.0), (Poses{10, 11})) << rate;
  }
  const auto standing = [](std::int64_t /*pose*/) { return 0.0; };
  EXPECT_EQ(otherSitesOf(3, standing, [](std::int64_t pose) { return pose == 2 ? 0.05 : 0.0; }), Poses{2});
  // Of set_date_time is told by the clock alone.
  const auto set = [](std::int64_t pose) { return pose == 2 ? kHour_s : 0.0; };
  EXPECT_EQ(otherSitesOf(4, set, [&](std::int64_t pose) { return set(pose) / 240.0; }), Poses());
}

TEST(OneSun, OfAnotherSiteIsLeftOutAndNamed) {
  Suns suns;
  CaptureRecord capture = captureAt(0, 0.0);
  capture.sun_elevation_deg = 20.0;
  EXPECT_TRUE(suns.add("h12", capture).empty());
  capture.stamp_ns = stampOf(1);
  capture.sun_elevation_deg = 32.5;
  const std::vector<OtherSun> others = suns.add("h12", capture);
  ASSERT_EQ(others.size(), 1u);
  EXPECT_EQ(
      others[0].fault,
      "its sun stands 12.5 deg from that of the captures before, farther than it turns meanwhile: was the "
      "site set (set_site)?");
  EXPECT_TRUE(suns.isOther("h12", stampOf(1)));
}

struct SetMeanwhile {
  bool is_late = false;  ///< captures come once all is compared
  bool is_set = true;    ///< the sun of h04, from pose 2 on
  bool is_killed = false;
};

Outcome evaluated(const TemporaryFolder& folder, const SetMeanwhile& how, std::string* notes = nullptr) {
  EvaluationOptions options = optionsFor(folder);
  options.streams = {"h04", "h12"};
  options.poses.count = 4;
  options.frame_rate = 10.0;
  options.stamp_start_ns = stampOf(0);
  const EvaluationCallbacks callbacks = notes != nullptr ? notingTo(notes) : EvaluationCallbacks();
  Evaluation evaluation(options, callbacks);
  const auto tell = [&](std::int64_t pose) {
    evaluation.addCapture(0, captureAt(pose, how.is_set && pose >= 2 ? kHour_s : -8 * kHour_s));
    evaluation.addCapture(1, captureAt(pose, 0.0));
  };
  for (std::int64_t pose = 0; pose < 4; ++pose) {
    if (!how.is_late) tell(pose);
    feedPose(evaluation, pose);
  }
  evaluation.waitForRoom(0);
  for (std::int64_t pose = 0; how.is_late && pose < 4; ++pose) tell(pose);
  EXPECT_TRUE(evaluation.isComplete());
  return how.is_killed ? Outcome() : evaluation.finish();
}

TEST(OneSun, PicturesUnderAnotherAreNotComparedAndNamed) {
  for (const bool is_late : {false, true}) {
    const TemporaryFolder folder;
    std::string notes;
    const Outcome outcome = evaluated(folder, {is_late}, &notes);
    EXPECT_FALSE(outcome.isWhole());
    EXPECT_EQ(outcome.counts.pairs[0].other_sun, 2u) << is_late;
    EXPECT_EQ(outcome.counts.pairs[0].evaluated, 2u) << is_late;
    EXPECT_EQ(outcome.counts.streams[0].other_sun, 2u);
    EXPECT_EQ(outcome.counts.streams[1].other_sun, 0u);
    const std::string frames = contentOf(folder.file("out/frames.csv"));
    EXPECT_TRUE(hasLine(frames, "1,500.100000000,h04,h12,"));
    EXPECT_FALSE(hasLine(frames, "2,500.200000000,")) << frames;
    const std::string fault = "its sky is of noon+3600, not of noon+-28800 as by the first capture" +
                              kWasSet +
                              " Left out; the same run again, with sun and site let alone, evaluates it";
    const std::string problems = contentOf(folder.file("out/problems.csv"));
    for (const char* place : {"other_sun,2,500.200000000,h04,", "other_sun,3,500.300000000,h04,"})
      EXPECT_TRUE(hasLine(problems, place + ('"' + fault + '"'))) << problems;
    EXPECT_EQ(notes, "h04: pose 2: " + fault + "\n") << "once";
    const std::string captures = contentOf(folder.file("out/captures.csv"));
    EXPECT_TRUE(hasLine(captures, "h04,1,")) << captures;
    EXPECT_FALSE(hasLine(captures, "h04,2,")) << captures;
    EXPECT_TRUE(hasLine(captures, "h12,2,")) << captures;
    const auto is_kept = [&](const std::string& picture) {
      return std::filesystem::exists(folder.file("out/images/" + picture));
    };
    EXPECT_TRUE(is_kept("h04/000000.png"));
    EXPECT_FALSE(is_kept("h04/000003.png")) << "nobody takes it for one of h04";
    EXPECT_TRUE(is_kept("h12/000003.png"));
    EXPECT_NE(contentOf(folder.file("out/run.yaml")).find("other_sun: 2, two_places: 0}"), std::string::npos);
  }
}

TEST(OneSun, IsMendedByTheSameRunAgain) {
  for (const bool is_killed : {false, true}) {
    const TemporaryFolder folder;
    evaluated(folder, {true, true, is_killed});
    EXPECT_TRUE(hasLine(contentOf(folder.file("out/problems.csv")), "other_sun,2,"));
    EXPECT_EQ(hasLine(contentOf(folder.file("out/frames.csv")), "2,500.200000000,"), is_killed);
    const Outcome outcome = evaluated(folder, {true, false});
    EXPECT_TRUE(outcome.isWhole());
    EXPECT_EQ(outcome.counts.pairs[0].resumed, 2u);
    EXPECT_EQ(outcome.counts.pairs[0].evaluated, 2u);
    EXPECT_EQ(contentOf(folder.file("out/problems.csv")), "kind,pose,stamp,where,reason\n");
  }
}

// Also by a run that is killed in its turn.
TEST(OneSun, IsMendedOnce) {
  const TemporaryFolder folder;
  evaluated(folder, {true, true});
  evaluated(folder, {true, false, true});
  EXPECT_TRUE(hasLine(contentOf(folder.file("out/problems.csv")),
                      "left_out_before,2,500.200000000,h04,\"other_sun: its sky is of noon+3600,"));
  const Outcome outcome = evaluated(folder, {true, false});
  EXPECT_EQ(outcome.counts.pairs[0].resumed, 4u);
  EXPECT_EQ(outcome.counts.pairs[0].evaluated, 0u);
  EXPECT_TRUE(outcome.isWhole());
  EXPECT_TRUE(hasLine(contentOf(folder.file("out/captures.csv")), "h04,3,"));
  EXPECT_EQ(contentOf(folder.file("out/problems.csv")), "kind,pose,stamp,where,reason\n");
}

TEST(OneSun, IsNamedOnceHoweverOftenItIsOther) {
  const TemporaryFolder folder;
  evaluated(folder, {true, true});
  const std::string problems = contentOf(folder.file("out/problems.csv"));
  const Outcome outcome = evaluated(folder, {true, true});
  EXPECT_EQ(outcome.counts.pairs[0].other_sun, 2u);
  EXPECT_EQ(outcome.not_mended, 0u) << "counted as what this run met";
  EXPECT_EQ(contentOf(folder.file("out/problems.csv")), problems);
}

// A renderer that begins anew sends pictures, too, that an earlier run evaluated under the right sun.
TEST(OneSun, IsNotThatOfPicturesThatAreNotAskedFor) {
  const TemporaryFolder folder;
  evaluated(folder, {false, false});
  const std::string captures = contentOf(folder.file("out/captures.csv"));
  const Outcome outcome = evaluated(folder, {false, true});
  EXPECT_TRUE(outcome.isWhole());
  EXPECT_EQ(outcome.counts.streams[0].other_sun, 0u);
  EXPECT_EQ(contentOf(folder.file("out/problems.csv")), "kind,pose,stamp,where,reason\n");
  EXPECT_EQ(contentOf(folder.file("out/captures.csv")), captures);
  EXPECT_EQ(evaluated(folder, {false, false}).counts.pairs[0].resumed, 4u);
}

// As where it is set while the renderer of the second run bakes: the sun that all its captures tell of jumps
// nowhere.
TEST(OneSun, IsThatOfWhatEarlierRunsEvaluated) {
  for (const bool is_set : {false, true}) {
    const TemporaryFolder folder;
    EvaluationOptions options = optionsFor(folder);
    options.frame_rate = 10.0;
    options.stamp_start_ns = stampOf(0);
    const auto evaluate = [&](std::int64_t first, std::int64_t end, bool other) {
      Evaluation evaluation(options, {});
      for (std::int64_t pose = first; pose < end; ++pose) {
        CaptureRecord capture = captureAt(pose, 6.0 * static_cast<double>(pose));  // it moves
        evaluation.addCapture(1, capture);
        if (other) capture = captureAt(pose, -3 * kHour_s + 6.0 * static_cast<double>(pose));
        evaluation.addCapture(0, capture);
        feedPose(evaluation, pose);
      }
      return evaluation.finish();
    };
    evaluate(0, 3, false);
    EXPECT_TRUE(hasLine(contentOf(folder.file("out/captures.csv")),
                        "h04,2,500.200000000,0,,0,0,0,0,0,0,noon+12,12\n"));
    const Outcome outcome = evaluate(3, 6, is_set);
    EXPECT_EQ(outcome.counts.streams[0].other_sun, is_set ? 3u : 0u);
    EXPECT_EQ(outcome.counts.streams[1].other_sun, 0u);
    EXPECT_EQ(outcome.counts.pairs[0].resumed, 3u);
    EXPECT_EQ(outcome.isWhole(), !is_set);
    EXPECT_EQ(hasLine(contentOf(folder.file("out/problems.csv")),
                      "other_sun,3,500.300000000,h04,\"its sky is of noon+-10782, not of noon+0 + 18 s"),
              is_set);
    EXPECT_TRUE(evaluate(3, 6, false).isWhole()) << "it is mended by the same run again";
  }
}

// And of its site, where it stands still.
TEST(OneSun, IsSeenFromTheSiteOfWhatEarlierRunsEvaluated) {
  Suns suns;
  CaptureRecord capture = captureAt(0, 0.0);
  capture.sun_elevation_deg = 20.0;
  suns.takeUp("h12", capture);
  capture.sun_elevation_deg = 32.5;
  EXPECT_EQ(suns.add("h12", capture).size(), 1u) << "also of the stamp of one that was taken up";
}

/// A run of some poses in a folder of its own, h12 of which has the sun of `clock_s`; or one that merges
/// such.
struct MergedRuns {
  double frame_rate = 0.0;
  const TemporaryFolder folder = {};

  EvaluationOptions options(const std::string& name) const {
    EvaluationOptions options = optionsFor(folder);
    options.output_dir = folder.file(name);
    options.frame_rate = frame_rate;
    if (frame_rate > 0.0) options.stamp_start_ns = stampOf(0);
    return options;
  }
  Outcome run(const std::string& name, std::int64_t first, std::int64_t end,
              const std::function<double(std::int64_t)>& clock_s) const {
    Evaluation evaluation(options(name), {});
    for (std::int64_t pose = first; pose < end; ++pose) {
      evaluation.addCapture(1, captureAt(pose, clock_s(pose)));
      feedPose(evaluation, pose);
    }
    return evaluation.finish();
  }
  /// Why these are not merged; empty where they are.
  std::string refusal(const std::vector<std::string>& names) const {
    EvaluationOptions merging = options("merged");
    for (const std::string& name : names) merging.merge.push_back(folder.file(name));
    return messageOf<std::invalid_argument>([&] { Evaluation(merging, {}).finish(); });
  }
};

double atNoon(std::int64_t /*pose*/) {
  return 0.0;
}
double anHourLater(std::int64_t /*pose*/) {
  return kHour_s;
}

TEST(OneSun, IsThatOfAllRunsThatAreMerged) {
  for (const double rate : {0.0, 10.0}) {
    const MergedRuns runs{rate};
    runs.run("start", 0, 20, atNoon);
    runs.run("end", 20, 40, atNoon);
    runs.run("other", 20, 40, anHourLater);
    const std::string fault = "its sky is of noon+3600, not of noon+0 as by the first capture" + kWasSet;
    for (const std::string first : {"start", "end"})
      EXPECT_EQ(runs.refusal({first, "other"}), "merge: " + runs.folder.file("other") +
                                                    " holds h12 under another sun than " +
                                                    runs.folder.file(first) + ": " + fault)
          << rate;
    EXPECT_FALSE(std::filesystem::exists(runs.folder.file("merged/captures.csv"))) << "nothing is changed";
    EXPECT_EQ(runs.refusal({"start", "end"}), "") << rate;
    EXPECT_NE(runs.refusal({"other"}), "") << "nor is one of those that are merged already";
  }
}

// A clock that begins anew with each run has other times at other poses, and by a rate it has not.
TEST(OneSun, OfRunsThatAreMergedMayMove) {
  for (const double rate : {0.0, 10.0}) {
    const MergedRuns runs{rate};
    runs.run("start", 0, 20, [](std::int64_t pose) { return 60.0 * static_cast<double>(pose); });
    runs.run("end", 20, 40, [](std::int64_t pose) { return 60.0 * static_cast<double>(pose); });
    runs.run("anew", 20, 40, [](std::int64_t pose) { return 60.0 * static_cast<double>(pose - 20); });
    EXPECT_EQ(runs.refusal({"start", "anew"}) == "", rate == 0.0) << rate;
    EXPECT_EQ(runs.refusal({"start", "end"}), "") << rate;
  }
}

TEST(OneSun, ThatStandsStillIsThatOfEarlierRunsWithoutARateToo) {
  const MergedRuns runs;
  runs.run("out", 0, 20, atNoon);
  const Outcome set = runs.run("out", 20, 23, anHourLater);
  EXPECT_EQ(set.counts.streams[1].other_sun, 3u);
  EXPECT_EQ(set.counts.streams[0].other_sun, 0u);
  EXPECT_TRUE(runs.run("out", 20, 23, atNoon).isWhole());
}

TEST(OneSun, IsSeenFromOneSiteByAllRunsThatAreMerged) {
  Captures here, there;
  for (std::int64_t pose = 0; pose < 3; ++pose) {
    here.push_back(captureAt(pose, 60.0 * static_cast<double>(pose)));
    there.push_back(here.back());
    there.back().sun_elevation_deg = 12.5;
  }
  for (const bool are_of_one_clock : {false, true}) {
    EXPECT_EQ(differenceOf(here, here, are_of_one_clock), "");
    EXPECT_NE(differenceOf(here, there, are_of_one_clock).find("12.5 deg from"), std::string::npos);
    EXPECT_EQ(differenceOf(here, {}, are_of_one_clock), "");
  }
}

// Of two stamps of a pose the earlier counts, whatever the later one is.
TEST(OneSun, OfALaterStampTakesNoPictureAway) {
  const TemporaryFolder folder;
  EvaluationOptions options = optionsFor(folder);
  options.frame_rate = 5.0;  // of images that come at 10 Hz: 1 and 2 are of pose 1
  options.stamp_start_ns = stampOf(0);
  options.images = KeptImages::kAll;
  Evaluation evaluation(options, {});
  for (std::int64_t pose = 0; pose < 4; ++pose) {
    evaluation.addCapture(0, captureAt(pose, pose == 2 ? kHour_s : 0.0));
    feedPose(evaluation, pose);
  }
  evaluation.finish();
  EXPECT_TRUE(hasLine(contentOf(folder.file("out/frames.csv")), "1,500.100000000,h04,h12,"));
  EXPECT_TRUE(std::filesystem::exists(folder.file("out/images/h04/000001.png")));
}

TEST(OneSun, IsNotAskedForWhereCapturesDoNotTell) {
  const TemporaryFolder folder;
  Evaluation evaluation(optionsFor(folder), {});
  for (std::int64_t pose = 0; pose < 4; ++pose) {
    CaptureRecord capture = captureAt(pose, 0.0);
    capture.utc.reset();
    capture.utc_text = pose == 3 ? "noon" : "";
    evaluation.addCapture(0, capture);
    feedPose(evaluation, pose);
  }
  EXPECT_TRUE(evaluation.finish().isWhole());
  EXPECT_EQ(
      contentOf(folder.file("out/problems.csv")),
      "kind,pose,stamp,where,reason\nunusable,3,500.300000000,h04,\"utc is \"\"noon\"\", so that nobody can "
      "tell whether its sun was set meanwhile\"\n");
}

}  // namespace
}  // namespace sunlit::evaluate
