// What an evaluation does not take: more than the memory that it may have, poses that nobody expects, names
// that lead elsewhere, and anything once it was broken off.
#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <mutex>

#include "sunlit/evaluate/files/stream_name.h"
#include "support/message_of.h"
#include "unit/evaluate/run/small_evaluation.h"

namespace sunlit::evaluate {
namespace {

constexpr std::size_t kSetBytes = 3 * 32 * 24 * 3;  // of three streams
const StopToken kAtOnce([] { return true; });

/// Holds who passes by until it is let go.
class Held {
 public:
  /// Those that hold the comparison of poses where it would tell of the first one.
  EvaluationCallbacks callbacks() {
    EvaluationCallbacks result;
    result.pair_done = [this](const PairRecord&, const cv::Mat&, const cv::Mat&) { pass(); };
    return result;
  }
  void reach() {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_reached_ = true;
    changed_.notify_all();
  }
  void pass() {
    reach();
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return is_let_go_; });
  }
  void waitUntilReached() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return is_reached_; });
  }
  void letGo() {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_let_go_ = true;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_reached_ = false;
  bool is_let_go_ = false;
};

TEST(MemoryLimit, GivesUpTheOldestWhereAllOnlyWait) {
  const TemporaryFolder folder;
  EvaluationOptions options = optionsFor(folder);
  options.images = KeptImages::kNone;
  options.memory_limit_bytes = 4 * kSetBytes;
  Evaluation evaluation(options, {});
  for (int pose = 0; pose < 6; ++pose) evaluation.addImage(0, stampOf(pose), picture(pose, 0));
  EXPECT_EQ(evaluation.counts().waiting_images, 4u);
  evaluation.addImage(1, stampOf(0), picture(0, 1));
  for (int pose = 2; pose < 6; ++pose) {
    for (std::size_t s = 1; s < 3; ++s) evaluation.addImage(s, stampOf(pose), picture(pose, s));
  }
  const Outcome outcome = evaluation.finish();
  EXPECT_EQ(outcome.counts.pairs[0].evaluated + outcome.counts.pairs[0].dropped, 6u);
  EXPECT_GE(outcome.counts.pairs[0].dropped, 2u);
  EXPECT_EQ(outcome.counts.streams[1].late, 1u);
  EXPECT_GE(outcome.counts.streams[0].dropped, 2u);
  EXPECT_LE(outcome.counts.bytes, options.memory_limit_bytes);
}

TEST(MemoryLimit, TurnsTheNewestAwayWhereComparisonsWillMakeRoom) {
  const TemporaryFolder folder;
  EvaluationOptions options = optionsFor(folder);
  options.images = KeptImages::kNone;
  options.memory_limit_bytes = 3 * kSetBytes;
  Held held;
  Evaluation evaluation(options, held.callbacks());
  feedPose(evaluation, 0);
  held.waitUntilReached();
  for (int pose = 1; pose < 4; ++pose) evaluation.addImage(0, stampOf(pose), picture(pose, 0));
  EXPECT_EQ(evaluation.counts().waiting_images, 2u);
  EXPECT_EQ(evaluation.counts().bytes, options.memory_limit_bytes);
  EXPECT_EQ(evaluation.counts().awaited_streams, (std::vector<std::size_t>{1, 2}));
  for (int pose = 1; pose < 4; ++pose) {
    for (std::size_t s = 1; s < 3; ++s) evaluation.addImage(s, stampOf(pose), picture(pose, s));
  }
  held.letGo();
  const Outcome outcome = evaluation.finish();
  for (const PairCounts& pair : outcome.counts.pairs) {
    EXPECT_EQ(pair.evaluated, 3u);
    EXPECT_EQ(pair.dropped, 1u);
  }
  EXPECT_EQ(outcome.counts.streams[0].dropped, 1u);
  EXPECT_EQ(outcome.counts.streams[1].late, 1u);
  EXPECT_FALSE(outcome.isWhole());
  EXPECT_TRUE(hasLine(contentOf(folder.file("out/problems.csv")), "dropped,3,500.300000000,h04-h12,"));
}

TEST(MemoryLimit, KeepsRoomForPartners) {
  const TemporaryFolder folder;
  EvaluationOptions options = optionsFor(folder);
  options.images = KeptImages::kNone;
  options.memory_limit_bytes = kSetBytes - 1;  // an image fits, but not those that belong to it
  Evaluation evaluation(options, {});
  feedPose(evaluation, 0);
  EXPECT_EQ(evaluation.counts().bytes, 0u);
  EXPECT_EQ(evaluation.finish().counts.streams[0].dropped, 1u);
}

// As a renderer sends poses again that no bag holds, and another none of them.
TEST(MemoryLimit, KeepsNoRoomForWhatAnEarlierRunEvaluated) {
  const TemporaryFolder folder;
  EvaluationOptions options = optionsFor(folder);
  options.images = KeptImages::kNone;
  options.memory_limit_bytes = 3 * kSetBytes;
  options.frame_rate = 10.0;
  options.stamp_start_ns = stampOf(0);
  options.pairs = {{"h04", "h12", 1}, {"h04", "h20", 2}};
  {
    Evaluation killed(options, {});
    for (int pose = 0; pose < 4; ++pose) {
      feedPose(killed, pose);
      killed.waitForRoom(0);
    }
  }
  Held held;
  Evaluation evaluation(options, held.callbacks());
  feedPose(evaluation, 4);
  held.waitUntilReached();
  for (int pose = 0; pose < 4; ++pose) evaluation.addImage(0, stampOf(pose), picture(pose, 0));
  EXPECT_EQ(evaluation.counts().waiting_images, 0u);
  for (int pose = 5; pose < 7; ++pose) evaluation.addImage(0, stampOf(pose), picture(pose, 0));
  for (int pose = 5; pose < 7; ++pose) {
    for (std::size_t s = 1; s < 3; ++s) evaluation.addImage(s, stampOf(pose), picture(pose, s));
  }
  for (int pose = 0; pose < 4; ++pose) evaluation.addImage(1, stampOf(pose), picture(pose, 1));
  held.letGo();
  const Outcome outcome = evaluation.finish();
  EXPECT_TRUE(outcome.isWhole());
  EXPECT_EQ(outcome.counts.pairs[0].evaluated, 3u);
  EXPECT_EQ(outcome.counts.pairs[0].resumed, 4u);
  for (const StreamCounts& stream : outcome.counts.streams) EXPECT_EQ(stream.late, 0u);
}

TEST(Evaluation, WritesAllFilesAtOnceWhereItIsBrokenOff) {
  const TemporaryFolder folder;
  Held held;
  Evaluation evaluation(optionsFor(folder), held.callbacks());
  const int poses = 40;
  for (int pose = 0; pose < poses; ++pose) feedPose(evaluation, pose);
  held.waitUntilReached();
  const Outcome outcome = evaluation.finish(kAtOnce);
  held.letGo();
  EXPECT_EQ(outcome.counts.completed_poses, static_cast<std::size_t>(poses));
  EXPECT_EQ(outcome.counts.queued_poses, 0u);
  for (const PairCounts& pair : outcome.counts.pairs) {
    EXPECT_EQ(pair.evaluated + pair.dropped, static_cast<std::size_t>(poses));
    EXPECT_GE(pair.dropped, static_cast<std::size_t>(poses - 2));  // two poses are compared at a time
  }
  const std::string problems = contentOf(folder.file("out/problems.csv"));
  EXPECT_NE(problems.find("h04-h12,the run was broken off before it was compared"), std::string::npos);
  EXPECT_NE(contentOf(folder.file("out/run.yaml")).find("whole: false"), std::string::npos);
  EXPECT_FALSE(contentOf(folder.file("out/summary.csv")).empty());
  // Taken up again, what was given up is evaluated, and not named any more.
  Evaluation again(optionsFor(folder), {});
  for (int pose = 0; pose < poses; ++pose) feedPose(again, pose);
  EXPECT_TRUE(again.finish().isWhole());
  EXPECT_EQ(contentOf(folder.file("out/problems.csv")).find("dropped,"), std::string::npos);
}

/// Takes as long as it is told to, as a detector does, or for ever unless it is stopped, as the matching of a
/// million features would.
class Slow : public Difference {
 public:
  enum class Kind { kHeld, kEndless };
  Slow(Kind kind, Held* held) : kind_(kind), held_(held) {}
  std::unique_ptr<Difference> clone() const override { return std::make_unique<Slow>(*this); }
  DifferenceValue between(const View&, const View&, const Matching&, const StopToken& stop) const override {
    if (kind_ == Kind::kHeld) held_->pass();
    for (held_->reach(); kind_ == Kind::kEndless;) stop.check();
    return sameBothWays(0.5);
  }

 private:
  Kind kind_;
  Held* held_;
};

EvaluationOptions slowOptions(const TemporaryFolder& folder, Slow::Kind kind, Held* held) {
  EvaluationOptions options = optionsFor(folder);
  options.comparer.known.add("slow", std::make_unique<Slow>(kind, held));
  options.comparer.differences = {"euclidean_grey", "slow"};
  return options;
}

void expectAllGivenUp(const Outcome& outcome, const TemporaryFolder& folder, std::size_t poses) {
  EXPECT_EQ(outcome.counts.completed_poses, poses);
  EXPECT_EQ(outcome.counts.bytes, 0u);
  for (const PairCounts& pair : outcome.counts.pairs) {
    EXPECT_EQ(pair.evaluated, 0u);
    EXPECT_EQ(pair.dropped, poses);
  }
  EXPECT_FALSE(contentOf(folder.file("out/summary.csv")).empty());
  EXPECT_NE(contentOf(folder.file("out/run.yaml")).find("whole: false"), std::string::npos);
}

TEST(Evaluation, DoesNotWaitForADetectorWhereItIsBrokenOff) {
  const TemporaryFolder folder;
  Held held;
  std::string files_at_the_end;
  {
    Evaluation evaluation(slowOptions(folder, Slow::Kind::kHeld, &held), {});
    for (int pose = 0; pose < 5; ++pose) feedPose(evaluation, pose);
    held.waitUntilReached();
    expectAllGivenUp(evaluation.finish(kAtOnce), folder, 5);
    files_at_the_end = contentOf(folder.file("out/frames.csv")) + contentOf(folder.file("out/problems.csv"));
    held.letGo();
  }
  // What it found after all is not written.
  EXPECT_EQ(contentOf(folder.file("out/frames.csv")) + contentOf(folder.file("out/problems.csv")),
            files_at_the_end);
}

TEST(Evaluation, IsBrokenOffWhileItWaitsForWhatIsLeft) {
  const TemporaryFolder folder;
  Held held;
  Evaluation evaluation(slowOptions(folder, Slow::Kind::kEndless, &held), {});
  for (int pose = 0; pose < 5; ++pose) feedPose(evaluation, pose);
  held.waitUntilReached();
  int asked = 0;
  const Outcome outcome = evaluation.finish(StopToken([&] {
    EXPECT_LE(evaluation.counts().completed_poses, 5u);  // who waits may tell how far it is
    return ++asked > 2;
  }));
  EXPECT_TRUE(outcome.is_broken_off);
  expectAllGivenUp(outcome, folder, 5);
}

TEST(Evaluation, StopsWhatIsBeingComparedWhereItIsBrokenOffOrGone) {
  const TemporaryFolder folder;
  Held held;
  {
    Evaluation evaluation(slowOptions(folder, Slow::Kind::kEndless, &held), {});
    feedPose(evaluation, 0);
    held.waitUntilReached();
    expectAllGivenUp(evaluation.finish(kAtOnce), folder, 1);
  }
  Held again;
  Evaluation evaluation(slowOptions(folder, Slow::Kind::kEndless, &again), {});
  feedPose(evaluation, 0);
  again.waitUntilReached();
}

TEST(ExpectedPoses, AreAbsentOrUnexpectedByMembershipNotByNumber) {
  const TemporaryFolder folder;
  EvaluationOptions options = optionsFor(folder);
  options.frame_rate = 10.0;
  options.stamp_start_ns = stampOf(0);
  options.poses.first = 10;
  options.poses.count = 6;  // 10, 12, 14
  options.poses.stride = 2;
  std::size_t progress = 0;
  EvaluationCallbacks callbacks;
  callbacks.progress = [&](std::size_t completed) { progress = completed; };
  Evaluation evaluation(options, callbacks);
  for (const int pose : {9, 10, 11, 14, 16}) feedPose(evaluation, pose);
  evaluation.waitForRoom(0);
  EXPECT_EQ(progress, 5u);  // a sender need not wait for what is turned away
  EXPECT_FALSE(evaluation.isComplete());
  const Outcome outcome = evaluation.finish();
  EXPECT_EQ(outcome.absent_poses, 1u);
  EXPECT_EQ(outcome.counts.unexpected_poses, 3u);
  EXPECT_EQ(outcome.counts.streams[2].unexpected, 3u);
  EXPECT_EQ(outcome.counts.pairs[0].evaluated, 2u);
  EXPECT_FALSE(outcome.isWhole());
  const std::string problems = contentOf(folder.file("out/problems.csv"));
  EXPECT_TRUE(hasLine(problems, "absent,12,,,"));
  EXPECT_FALSE(hasLine(problems, "absent,11,"));
  for (const char* pose : {"9,500.900000000", "11,501.100000000", "16,501.600000000"})
    EXPECT_TRUE(hasLine(problems, "unexpected," + std::string(pose) + ",h20,")) << pose;
  const std::string frames = contentOf(folder.file("out/frames.csv"));
  EXPECT_TRUE(hasLine(frames, "14,"));
  EXPECT_FALSE(hasLine(frames, "16,"));
  Evaluation again(options, {});
  feedPose(again, 12);
  again.waitForRoom(0);
  EXPECT_TRUE(again.isComplete());
  EXPECT_TRUE(again.finish().isWhole());
}

TEST(ExpectedPoses, AreNumberedInTheirOrderWhereOnlyStampsTell) {
  const TemporaryFolder folder;
  EvaluationOptions options = optionsFor(folder);
  options.poses.first = 500;
  options.poses.count = 30;
  options.poses.stride = 10;
  Evaluation evaluation(options, {});
  for (int pose = 0; pose < 3; ++pose) feedPose(evaluation, pose);
  EXPECT_TRUE(evaluation.finish().isWhole());
  const std::string frames = contentOf(folder.file("out/frames.csv"));
  for (const char* pose : {"500,500.0", "510,500.1", "520,500.2"}) EXPECT_TRUE(hasLine(frames, pose)) << pose;
}

TEST(Evaluation, CountsWhatItIsToldWasLostOrCompressed) {
  const TemporaryFolder folder;
  std::vector<std::string> notes;
  EvaluationCallbacks callbacks;
  callbacks.note = [&](const std::string& line) { notes.push_back(line); };
  Evaluation evaluation(optionsFor(folder), callbacks);
  for (int pose = 0; pose < 2; ++pose) {
    evaluation.addImage(0, stampOf(pose), picture(pose, 0), {true, false});
    for (std::size_t s = 1; s < 3; ++s) evaluation.addImage(s, stampOf(pose), picture(pose, s));
  }
  evaluation.addLost(2, 7, stampOf(1));
  const Outcome outcome = evaluation.finish();
  EXPECT_TRUE(outcome.isWhole());
  EXPECT_EQ(outcome.counts.streams[0].lossy, 2u);
  EXPECT_EQ(outcome.counts.streams[2].lost, 7u);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(notes[0].rfind("h04: images are compressed with loss", 0), 0u);
  EXPECT_TRUE(hasLine(contentOf(folder.file("out/problems.csv")),
                      "lost,,500.100000000,h20,\"by their sequence numbers 7 images"));
  EXPECT_NE(contentOf(folder.file("out/run.yaml")).find("lossy: 2"), std::string::npos);
}

// A camera that switches its mode, or another one under a name; the light did not change so.
TEST(Evaluation, SaysOnceThatAStreamTurnsGreyAndThatAPairIsOfGreyAndColour) {
  const TemporaryFolder folder;
  std::vector<std::string> notes;
  EvaluationCallbacks callbacks;
  callbacks.note = [&](const std::string& line) { notes.push_back(line); };
  Evaluation evaluation(optionsFor(folder), callbacks);
  const auto feed = [&](std::int64_t pose, bool is_grey) {
    evaluation.addImage(0, stampOf(pose), picture(pose, 0), {false, is_grey});
    for (std::size_t s = 1; s < 3; ++s) evaluation.addImage(s, stampOf(pose), picture(pose, s));
  };
  feed(0, false);
  EXPECT_TRUE(notes.empty());
  for (int pose = 1; pose < 4; ++pose) feed(pose, pose != 2);
  EXPECT_TRUE(evaluation.finish().isWhole());
  EXPECT_EQ(notes,
            (std::vector<std::string>{
                "h04: images are grey from stamp 500.100000000 on, and were in colour before: "
                "differences contain what that changed",
                "h04-h12: images of h04 are grey, those of h12 in colour: differences contain what that "
                "changed",
                "h04-h20: images of h04 are grey, those of h20 in colour: differences contain what that "
                "changed"}));
}

TEST(Evaluation, TakesAnImageInThePlaceOfOneThatCannotBeUsedAndSaysSo) {
  const TemporaryFolder folder;
  Evaluation evaluation(optionsFor(folder), {});
  evaluation.addBadImage(0, stampOf(0), "cut short");
  feedPose(evaluation, 0);
  evaluation.addImage(0, stampOf(0), picture(9, 0));  // is none the less a second one
  feedPose(evaluation, 1);
  const Outcome outcome = evaluation.finish();
  EXPECT_TRUE(outcome.isWhole());
  EXPECT_EQ(outcome.counts.streams[0].received, 4u);
  EXPECT_EQ(outcome.counts.streams[0].undecodable, 1u);
  EXPECT_EQ(outcome.counts.streams[0].duplicate, 1u);
  const std::string problems = contentOf(folder.file("out/problems.csv"));
  EXPECT_TRUE(hasLine(problems,
                      "replaced,0,500.000000000,h04,an image of this stamp had come before that could not be "
                      "used; this one counts"))
      << problems;
  EXPECT_TRUE(hasLine(problems, "undecodable,0,500.000000000,h04,cut short"));
}

TEST(StreamNames, AreThoseThatLeadNowhereElse) {
  for (const char* name : {"h04", "h04_30", "self_test/h04", "a/1", "B_2/c"})
    EXPECT_TRUE(isStreamName(name)) << name;
  for (const char* name : {"",   "/h04", "h04/", "a//b", "..",  "../x", "a/../../x", "a/./b", "1a",  "_a",
                           "~a", "a b",  "a,b",  "a\nb", "a'b", "a\"b", "a\\b",      "ä",     "a-b", "a.png"})
    EXPECT_FALSE(isStreamName(name)) << name;
}

TEST(StreamNames, AreAskedForByEveryDoor) {
  const TemporaryFolder folder;
  EvaluationOptions options = optionsFor(folder);
  options.streams = {"h04", "../../elsewhere"};
  const std::string message = messageOf([&] { const Evaluation evaluation(options, {}); });
  EXPECT_NE(message.find("a name in streams is \"../../elsewhere\", but must be the name of a stream"),
            std::string::npos)
      << message;
  // By way of what another run left.
  options.streams = {"h04", "h12"};
  {
    Evaluation other(options, {});
    CaptureRecord capture;
    capture.stamp_ns = stampOf(0);
    other.addCapture(0, capture);
    feedPose(other, 0);
    other.finish();
  }
  std::string captures = contentOf(folder.file("out/captures.csv"));
  setContent(folder.file("out/captures.csv"), captures.replace(captures.find("\nh04,"), 5, "\n../h04,"));
  const std::string refused =
      messageOf<std::runtime_error>([&] { const Evaluation evaluation(options, {}); });
  EXPECT_NE(refused.find("captures.csv:2: stream is \"../h04\""), std::string::npos) << refused;
}

TEST(TakenUpRun, NamesFileAndLineOfWhatItCannotRead) {
  const TemporaryFolder folder;
  const auto refusal = [&](const std::string& name, const std::string& text) {
    setContent(folder.file("out/") + name, text);
    const std::string told =
        messageOf<std::runtime_error>([&] { Evaluation evaluation(optionsFor(folder), {}); });
    std::filesystem::remove(folder.file("out/") + name);
    return told;
  };
  const std::string out = folder.file("out");
  EXPECT_EQ(refusal("path.csv", "pose,stamp,x,y,z,yaw_deg\n0,1000.000000000,0,0,,90\n"),
            out + "/path.csv:2: \"\" is not a number");
  EXPECT_EQ(refusal("problems.csv", "kind,pose,stamp,where,reason\nlost,9223372036854775808,,a,b\n"),
            out + "/problems.csv:2: \"9223372036854775808\" is not a pose number");
  EXPECT_EQ(refusal("captures.csv",
                    "stream,pose,stamp,ev100,exposure_mode,sun_azimuth_deg,sun_elevation_deg,"
                    "moon_azimuth_deg,moon_elevation_deg,moon_illuminated_fraction,scene_illuminance,utc,"
                    "utc_s\nh04,0,1,14,auto,90,20,nan,nan,nan,5,,nan\n"),
            out + "/captures.csv:2: \"1\" is not a stamp with nine digits after the point");
  const std::string older =
      refusal("captures.csv",
              "stream,pose,stamp,ev100,sun_azimuth_deg,sun_elevation_deg,moon_azimuth_deg,moon_elevation_deg,"
              "moon_illuminated_fraction,scene_illuminance\nh04,0,1000.000000000,14,90,20,nan,nan,nan,5\n");
  EXPECT_EQ(older.rfind(out + "/captures.csv:1: was written by another version", 0), 0u) << older;
}

}  // namespace
}  // namespace sunlit::evaluate
