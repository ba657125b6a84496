#include "ros/evaluator/evaluator_node.h"

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <std_msgs/UInt32.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <iostream>

#include "ros/conversions/evaluation.h"
#include "sunlit/evaluate/features/draw.h"
#include "sunlit/ros/delivery.h"
#include "sunlit/ros/node_main.h"
#include "sunlit/ros/topic_names.h"

namespace sunlit::ros_interface {
namespace {

constexpr double kComparingAtMost_s = 2.0;  // once interrupted, of the 10 s until all is written

/// By a signal, or without one, as `rosnode kill` does. Any thread may ask.
bool isAskedToEnd() {
  return isInterrupted() || !ros::ok();
}

/// ROS says nothing more once it shuts down.
void tell(ros::console::Level level, const std::string& text) {
  using namespace ros::console::levels;
  if (ros::ok())
    ROS_LOG(level, ROSCONSOLE_DEFAULT_NAME, "%s", text.c_str());
  else
    std::cerr << (level == Error ? "[ERROR] " : level == Warn ? "[ WARN] " : "[ INFO] ") << text << std::endl;
}

/// Lasts until so long after that.
class Patience {
 public:
  Patience(double seconds, bool is_asked)
      : length_ns_(static_cast<std::int64_t>(1e9 * seconds)), since_ns_(is_asked ? now() : kNever) {}
  /// Thread-safe.
  bool isOver() const {
    std::int64_t never = kNever;
    if (isAskedToEnd()) since_ns_.compare_exchange_strong(never, now());
    const std::int64_t since_ns = since_ns_;
    return since_ns != kNever && now() - since_ns > length_ns_;
  }

 private:
  static constexpr std::int64_t kNever = -1;
  static std::int64_t now() {
    return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
  }
  std::int64_t length_ns_;
  mutable std::atomic<std::int64_t> since_ns_;
};

}  // namespace

namespace {

EvaluatorOptions withCache(EvaluatorOptions options) {
  options.evaluation.comparer.cache = evaluate::FeatureCache::usual(
      options.features_cache_gb, [](const std::string& line) { ROS_WARN("%s", line.c_str()); });
  return options;
}

}  // namespace

EvaluatorNode::EvaluatorNode(ros::NodeHandle node, ros::NodeHandle private_node,
                             const EvaluatorOptions& options)
    : options_(withCache(options)),
      lock_(options.evaluation.output_dir),
      localisation_(private_node, options.evaluation),
      activity_(private_node) {
  // roscpp's own handler ends the log and all topics before results could be written and told. Images may
  // come from the first subscription on.
  holdInterrupts();
  pair_difference_ = private_node.advertise<PairDifference>(topics::kPairDifference, 100);
  summary_ = private_node.advertise<Summary>(topics::kSummary, 1, true);
  progress_ = private_node.advertise<std_msgs::UInt32>(topics::kProgress, 1, true);
  matches_image_ = private_node.advertise<sensor_msgs::Image>(topics::kMatchesImage, 2);

  evaluate::EvaluationCallbacks callbacks;
  callbacks.progress = [this](std::size_t passed) { publishProgress(passed); };
  callbacks.note = [](const std::string& line) { ROS_INFO("%s", line.c_str()); };
  callbacks.pair_done = [this](const evaluate::PairRecord& record, const cv::Mat& a, const cv::Mat& b) {
    onPairDone(record, a, b);
  };
  evaluation_ = std::make_unique<evaluate::Evaluation>(options_.evaluation, callbacks);

  intake_ = std::make_unique<ImageIntake>(node, options.intake, *evaluation_);
  // Not before it listens: who waits for our progress begins to send.
  publishProgress(evaluation_->counts().passed_poses);
  diagnostics_ = std::make_unique<EvaluatorDiagnostics>(node, private_node, *evaluation_, *intake_);
  finish_ = private_node.advertiseService("finish", &EvaluatorNode::onFinish, this);
}

EvaluatorNode::~EvaluatorNode() = default;

// From several threads, of which one may be overtaken; it never falls.
void EvaluatorNode::publishProgress(std::size_t passed) {
  const std::lock_guard<std::mutex> lock(progress_mutex_);
  passed_ = std::max(passed_, passed);
  std_msgs::UInt32 message;
  message.data = static_cast<std::uint32_t>(passed_);
  progress_.publish(message);
}

void EvaluatorNode::onPairDone(const evaluate::PairRecord& record, const cv::Mat& a, const cv::Mat& b) {
  PairDifference message = messageOf(evaluation_->options(), record);
  pair_difference_.publish(message);
  if (matches_image_.getNumSubscribers() == 0) return;
  const evaluate::ComparerOptions& options = evaluation_->options().comparer;
  const cv::Mat drawn = evaluate::drawMatches(evaluate::firstDetectorOf(options), options.ratio_test, {a, b},
                                              evaluation_->stopToken());
  matches_image_.publish(messageOf(drawn, message.header));
}

// The answer leaves when the files are there.
bool EvaluatorNode::onFinish(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  try {
    if (!is_finished_) finish("asked to finish");
    if (fault_) std::rethrow_exception(fault_);
    response.success = true;
    response.message =
        "results are in " + options_.evaluation.output_dir + (faults_.empty() ? "" : "; ") + faults_;
  } catch (const std::exception& error) {
    fault_ = std::current_exception();
    response.success = false;
    response.message = error.what();
  }
  return true;
}

bool EvaluatorNode::isIdle() const {
  const bool is_busy = evaluation_->counts().queued_poses > 0;
  return options_.idle_timeout_s > 0.0 && !is_busy &&
         intake_->secondsWithoutImage() > options_.idle_timeout_s;
}

std::string EvaluatorNode::reasonToFinish() const {
  if (evaluation_->isComplete())
    return "all " + std::to_string(options_.evaluation.poses.size()) + " poses are accounted for";
  if (isIdle()) return "no image for " + plainText(options_.idle_timeout_s) + " s";
  return "";
}

// What is left to compare may take minutes: whoever interrupts meanwhile is heeded.
void EvaluatorNode::finish(const std::string& reason) {
  ROS_INFO("%s; writing results", reason.c_str());
  is_finished_ = true;
  const evaluate::Outcome outcome = evaluation_->finish(evaluate::StopToken([this] {
    diagnostics_->update();
    log_.update(options_.evaluation, evaluation_->counts());
    return isAskedToEnd();
  }));
  Summary message = messageOf(outcome.summary, outcome.counts.evaluatedPoses());
  message.header.stamp = ros::Time::now();
  summary_.publish(message);
  // A table of nothing would only hide the reason that stands above it.
  std::string table;
  if (outcome.counts.evaluatedPoses() > 0)
    table = "\n" + summaryTable(outcome.summary) + verifiedTable(outcome.verified);
  tell(ros::console::levels::Info, std::to_string(outcome.counts.evaluatedPoses()) + " poses in " +
                                       options_.evaluation.output_dir + table);
  faults_ = faultsOf(evaluation_->options(), outcome);
  if (const std::string silent = intake_->silentTopics(); !faults_.empty() && !silent.empty())
    faults_ += "; no image came of " + silent;
  if (!faults_.empty()) tell(ros::console::levels::Error, faults_);
  const std::string remarks = remarksOf(evaluation_->options(), outcome.counts);
  if (!remarks.empty()) tell(ros::console::levels::Warn, remarks);
  if (!outcome.is_broken_off) localise();
  compareMethods(outcome.is_broken_off);
  if (options_.report && !outcome.is_broken_off && !isAskedToEnd()) drawReport(outcome);
  status_ = faults_.empty() ? 0 : kNotWholeStatus;
  activity_.say("done", "", {1.0, 0.0});
}

// What is interrupted here is done anew by whoever takes the run up again.
void EvaluatorNode::localise() {
  if (const std::string frame = intake_->frameOfPoses(); !frame.empty()) localisation_.setFrame(frame);
  QueryLog log;
  evaluate::LocaliseCallbacks callbacks;
  callbacks.found = [this](const evaluate::LocalisationRow& row) { localisation_.publish(row); };
  callbacks.progress = [&](std::size_t done, std::size_t all) {
    log.update(done, all);
    activity_.say("localising", "",
                  {static_cast<double>(done) / static_cast<double>(all), log.secondsLeft(done)});
  };
  callbacks.stop = evaluate::StopToken(isAskedToEnd);
  try {
    const evaluate::LocalisationOutcome outcome = evaluation_->localise(callbacks);
    if (outcome.is_asked || !outcome.summary.empty()) localisation_.publish(outcome.summary);
    if (!outcome.summary.empty()) ROS_INFO("\n%s", localisationTable(outcome.summary).c_str());
    const std::string faults = faultsOf(outcome);
    if (faults.empty()) return;
    ROS_ERROR("%s", faults.c_str());
    faults_ += (faults_.empty() ? "" : "; ") + faults;
  } catch (const evaluate::Stopped&) {
    faults_ += std::string(faults_.empty() ? "" : "; ") + "interrupted before all queries were localised";
    tell(ros::console::levels::Warn,
         "interrupted before all queries were localised; the same run again does it");
  }
}

// Of a run that is broken off, whatever takes no longer than who breaks it off has patience.
void EvaluatorNode::compareMethods(bool is_broken_off) {
  const Patience patience(kComparingAtMost_s, is_broken_off);
  try {
    evaluation_->compareMethods(evaluate::StopToken([&] { return patience.isOver(); }));
  } catch (const evaluate::Stopped&) {
    tell(
        ros::console::levels::Warn,
        "interrupted before methods and hours were compared: there is no comparisons.csv; the same run again "
        "writes it");
  }
}

void EvaluatorNode::drawReport(const evaluate::Outcome& outcome) {
  activity_.say("reporting");
  try {
    const evaluate::StopToken stop(isAskedToEnd);
    const std::string fault = drawnReport(evaluation_->options(), outcome.counts, stop);
    if (!fault.empty()) ROS_WARN("%s", fault.c_str());
  } catch (const evaluate::Stopped&) {
    tell(ros::console::levels::Warn, "interrupted before the report was drawn; the same run again draws it");
  }
}

int EvaluatorNode::run() {
  const ros::WallDuration kPatience(0.05);  // how late the end may be noticed
  while (!isAskedToEnd()) {
    ros::getGlobalCallbackQueue()->callAvailable(kPatience);
    diagnostics_->update();
    if (fault_) {
      deliverTheLast();
      std::rethrow_exception(fault_);
    }
    if (!is_finished_) {
      lock_.requireInPlace();
      intake_->rethrow();
      log_.update(options_.evaluation, evaluation_->counts());
      const std::string reason = reasonToFinish();
      if (!reason.empty()) finish(reason);
    } else if (!has_warned_ && evaluation_->counts().after_end > 0) {
      has_warned_ = true;
      ROS_WARN("Images come after the end and are left out: only a node that is started anew takes them");
    }
    if (is_finished_ && options_.exit_when_done) {
      ros::getGlobalCallbackQueue()->callAvailable();  // others who asked to finish meanwhile
      deliverTheLast();
      return status_;
    }
  }
  if (!is_finished_) finish(isInterrupted() ? "interrupted" : "shut down");
  return status_;
}

}  // namespace sunlit::ros_interface
