/// The workings of Evaluation.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <shared_mutex>
#include <string>
#include <utility>
#include <vector>

#include "evaluate/files/files.h"
#include "evaluate/files/picture_writer.h"
#include "evaluate/run/accounted_poses.h"
#include "evaluate/run/extreme_poses.h"
#include "evaluate/run/grey_streams.h"
#include "evaluate/run/observer.h"
#include "evaluate/run/one_place.h"
#include "evaluate/run/pose_index.h"
#include "evaluate/run/pose_work.h"
#include "evaluate/run/record_files.h"
#include "evaluate/run/stamp_sets.h"
#include "evaluate/run/work_queue.h"
#include "sunlit/evaluate/comparisons/measured.h"
#include "sunlit/evaluate/run/evaluation.h"
#include "sunlit/evaluate/run/one_sun.h"
#include "sunlit/evaluate/verify/verified_file.h"

namespace sunlit::evaluate {

/// Images go from `sets_` (waiting for partners) to `queue_` (being compared) to `records_` and frames.csv.
/// `mutex_` guards everything but the queue; comparing runs outside of it. What a run that is broken off may
/// find under way stands in `under_way_`: it is either kept whole, under `writing_`, or given up by finish().
class Evaluation::State {
 public:
  State(const EvaluationOptions& options, EvaluationCallbacks callbacks);
  ~State() { is_broken_off_ = true; }  // whoever goes without an end waits for nothing

  const EvaluationOptions& options() const { return options_; }
  void add(std::size_t stream, std::int64_t stamp_ns, Arrival arrival);
  void add(std::size_t stream, const CaptureRecord& capture);
  void add(const PlaceRecord& place);
  void addDepth(std::int64_t stamp_ns, const Told<cv::Mat>& depth);
  void addTruePose(std::int64_t stamp_ns, const Told<Eigen::Isometry3d>& map_from_optical);
  void addCamera(std::size_t stream, std::int64_t stamp_ns, const Told<ViewCamera>& camera);
  void addPoseProblem(std::int64_t stamp_ns, const std::string& kind, const std::string& reason);
  LocalisationOutcome localise(const LocaliseCallbacks& callbacks);
  void compareMethods(const StopToken& stop);
  void addLost(std::size_t stream, std::size_t images, std::int64_t stamp_ns);
  void note(std::size_t stream, std::int64_t stamp_ns, const ImageTraits& traits);
  const StopToken& stopToken() const { return stop_; }
  Counts counts() const;
  bool isComplete() const;
  void waitForRoom(std::size_t queued_poses) const;
  Outcome finish(const StopToken& broken_off);

 private:
  enum class Reason { kWhole, kEnd, kMemory };
  using StampsOfPairs = std::map<std::pair<std::int64_t, std::size_t>, std::int64_t>;  // by pose and pair
  using Work = PoseWork;
  using Values = PoseValues;
  static constexpr const char* kLostFile = "lost_features.bin";
  std::string file(const std::string& name) const { return options_.output_dir + "/" + name; }
  void takeUpEarlierRuns();
  void requireMergeable(const std::string& folder) const;
  void requireNothingForgotten() const;
  LeftLines takeUp(const std::string& folder);
  void tellTakenUp(const LeftLines& left) const;
  void noteLeftOutBefore(const std::string& folder);
  void settleTakenUp();
  bool isHeldWhole(std::int64_t pose) const;
  bool isOfEarlierRun(const PairRecord& record) const;
  void takeUpPoses();
  std::size_t nameAbsentPoses();
  bool isWanted(std::size_t pair, std::int64_t pose) const;
  bool isHeld(std::int64_t stamp_ns, std::int64_t pose, std::size_t pair) const;
  bool isAskedFor(std::size_t stream, std::int64_t stamp_ns, std::int64_t pose) const;
  std::vector<char> neededStreams(std::int64_t stamp_ns, std::int64_t pose) const;
  bool hasAllImages(const StampSet& set, std::int64_t pose) const;
  bool isWhole(const StampSet& set, std::int64_t pose) const;
  void closeIfWhole(std::int64_t stamp_ns);
  void closeWhole(std::int64_t last_ns);
  void addLate(std::size_t stream, std::int64_t stamp_ns, std::optional<std::int64_t> pose);
  void turnAway(std::size_t stream, std::int64_t stamp_ns, std::int64_t pose);
  void keepWithinMemory(std::int64_t newest_ns);
  void handOverComplete(std::size_t most_bytes, std::int64_t newest_ns);
  void close(std::int64_t stamp_ns, std::optional<std::int64_t> pose, Reason reason);
  bool takes(std::int64_t stamp_ns, std::int64_t pose, std::size_t pair);
  void replaceHeld(std::int64_t pose, std::size_t pair);
  void withdraw(std::int64_t stamp_ns, std::size_t pair);
  bool isOfTwoPlaces(std::int64_t stamp_ns, std::optional<std::int64_t> pose, std::size_t pair);
  bool isLeftOut(std::int64_t stamp_ns, std::optional<std::int64_t> pose, std::size_t pair);
  void nameOtherSuns(std::size_t stream, const std::vector<OtherSun>& others);
  std::optional<std::int64_t> poseOfImage(std::int64_t stamp_ns);
  void learn(const CaptureRecord& capture);
  void forgetOrder();
  void separate(std::int64_t stamp_ns);
  void leaveOutUnplaced();
  void removePictures(std::int64_t stamp_ns, std::int64_t pose);
  bool isLeftOutCapture(const std::string& stream, const CaptureRecord& capture) const;
  bool canCompare(const StampSet& set, std::size_t pair, std::optional<std::int64_t> pose, Reason reason);
  bool isSample(std::int64_t pose) const;
  std::vector<std::size_t> keptPictures(const StampSet& set, std::int64_t pose, bool is_evaluated);
  void keepLate(std::size_t stream, std::int64_t stamp_ns, std::int64_t pose, const cv::Mat& rgb);
  void writePictures(const Work& work);
  void handOver(Work work, const StampSet& set);
  void evaluate(const Work& work);
  void evaluatePairs(const Work& work);
  Values noValues(const Work& work) const;
  Values compare(const Work& work) const;
  std::vector<PairRecord> keepAll(const Work& work, const Values& values);
  std::optional<PairRecord> keep(const Work& work, const Values& values, std::size_t i);
  void settle(const Work& work);
  void tell(const Work& work, const std::vector<PairRecord>& records);
  void waitForWork(const StopToken& broken_off);
  void giveUpWork();
  bool isVerifying() const { return !verified_layout_.differences.empty(); }
  void prepareLocalisation();
  void addTruth(std::int64_t stamp_ns, const std::function<void(GroundTruth&)>& add);
  void observeSet(const StampSet& set, Work& work);
  std::size_t truthBytes() const { return observer_ ? observer_->truth().bytes() : 0; }
  std::vector<LocalisationRow> localisedBefore() const;
  bool canLocalise() const;
  void forgetLocalised() const;
  bool hasForgottenObservations(const std::string& folder) const;
  bool isWholePath() const;
  std::size_t evaluatedBut(const StreamPoses& some, const std::vector<std::string>& streams) const;
  std::vector<std::string> uncompared(const ObservedStreams& streams, std::set<std::string> found) const;
  bool isObserved(const Work& work, std::size_t stream, std::size_t difference) const;
  void reportUnlocalised(const Work& work, std::size_t stream, const std::string& fault);
  void verifyMatched(const Work& work, const Matched& matched, Values& values) const;
  std::string drawnName(std::size_t pair, std::size_t detector) const;
  void claimDrawn(const Work& work);
  void writeDrawn(const Work& work, const Values& values);
  bool isSelfTested(std::size_t pair) const;
  bool isToBeDrawn(const Work& work, std::size_t pair, std::size_t detector, const Verified& verified) const;
  ExtremePoses& extremes(std::size_t pair, std::size_t detector);
  void rankAll();
  void rankKept(const VerifiedRecord& verified);
  void removeFallen();
  void keepFinalDrawn();
  void writeLostFeatures();
  bool hasForgottenFeatures() const;
  void withdrawVerified(std::int64_t stamp_ns, std::size_t pair);
  std::size_t takeUpVerified(const std::string& folder, std::vector<PairRecord>& frames);
  void settleRecords();
  void writeRecords() const;
  void giveUp(const Work& work);
  void complete(std::int64_t pose);
  void report(const Problem& problem) { problems_->add(problem); }
  std::optional<std::int64_t> poseOf(const Problem& problem) const;
  bool isMended(const Problem& problem, const StampsOfPairs& evaluated) const;
  std::size_t countNotMended(const std::vector<Problem>& earlier) const;
  void forgetEarlierResults();
  void settleAndWrite(Outcome& outcome);
  std::vector<VerifiedSummaryRow> writeVerifiedSummaries() const;

  EvaluationOptions options_;
  EvaluationCallbacks callbacks_;
  Comparer comparer_;
  FramesLayout layout_, verified_layout_;  // of all differences, and of the detectors verified
  std::vector<std::pair<std::size_t, std::size_t>> pair_streams_;
  mutable std::mutex mutex_;
  mutable std::mutex callback_mutex_;
  PoseIndex poses_;
  StampSets sets_;
  OnePlace places_;
  Suns suns_;
  GreyStreams grey_;
  std::set<std::pair<std::string, std::int64_t>> left_out_before_;  // streams and stamps
  Counts counts_;
  std::vector<PairRecord> records_;
  std::vector<VerifiedRecord> verified_;  // of the same stamps and pairs, where matches are verified
  std::vector<Measured> localised_;       // by localise()
  Outcome finished_;                      // by finish()
  bool has_forgotten_ = false;            // single features or observations of what was taken up
  StampsOfPairs held_;                    // what earlier runs left
  StampsOfPairs taken_;                   // the stamp that counts of those come
  AccountedPoses completed_;
  std::size_t queued_bytes_ = 0;  // of images in queue_
  bool is_finished_ = false;
  std::atomic<bool> is_broken_off_{false};
  StopToken stop_{[this] { return is_broken_off_.load(); }};
  std::shared_mutex writing_;  // shared by workers that write, or keep rows
  std::multimap<std::int64_t, std::shared_ptr<const Work>> under_way_;  // by stamp: in queue_, not kept yet
  std::set<std::int64_t> sampled_;                                      // poses whose images are kept
  std::unique_ptr<RecordFiles> record_files_;
  std::unique_ptr<ProblemFile> problems_;
  std::unique_ptr<PictureWriter> pictures_, drawn_;  // drawn where matches are verified and images kept
  std::vector<ExtremePoses> extremes_;               // by pair and detector; drawn, as the sampled poses are
  std::vector<std::pair<std::string, std::int64_t>> fallen_;  // drawn, but among the extremes no more
  std::unique_ptr<Observer> observer_;                        // where it is localised
  AppendFile frames_file_, verified_file_, lost_file_;
  WorkQueue queue_;  // last, so that its threads end before what they use
};

}  // namespace sunlit::evaluate
