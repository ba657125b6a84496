#include "ros/evaluator/evaluator_diagnostics.h"

#include <string>

namespace sunlit::ros_interface {
namespace {

constexpr double kBytesPerMegabyte = 1e6;

std::string awaited(const evaluate::EvaluationOptions& options, const evaluate::Counts& counts) {
  if (counts.waiting_images == 0) return counts.queued_poses > 0 ? "comparisons" : "images";
  std::string names;
  for (const std::size_t s : counts.awaited_streams)
    names += (names.empty() ? "" : ", ") + options.streams[s];
  if (counts.awaits_truth) return "camera/pose, camera/depth/image_raw or camera_info";
  return names.empty() ? "captures" : "images of " + names;
}

}  // namespace

EvaluatorDiagnostics::EvaluatorDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                                           const evaluate::Evaluation& evaluation, const ImageIntake& intake)
    : evaluation_(evaluation),
      intake_(intake),
      updater_(node, private_node),
      received_(evaluation.options().streams.size(), 0) {
  updater_.add("evaluation", [this](WallUpdater::Status& status) { tell(status); });
}

void EvaluatorDiagnostics::tell(WallUpdater::Status& status) {
  const evaluate::EvaluationOptions& options = evaluation_.options();
  const evaluate::Counts counts = evaluation_.counts();
  const ros::SteadyTime now = ros::SteadyTime::now();
  const double elapsed_s = (now - last_).toSec();
  last_ = now;
  std::size_t failures = 0;
  status.add("completed poses", counts.completed_poses);
  status.add("expected poses", options.poses.size() > 0 ? std::to_string(options.poses.size()) : "unknown");
  status.add("unexpected poses", counts.unexpected_poses);
  status.add("poses being compared or queued", counts.queued_poses);
  status.add("images that wait for a partner", counts.waiting_images);
  status.addf("memory", "%.1f of %.1f MB", static_cast<double>(counts.bytes) / kBytesPerMegabyte,
              static_cast<double>(options.memory_limit_bytes) / kBytesPerMegabyte);
  status.add("waits for", awaited(options, counts));
  for (std::size_t s = 0; s < options.streams.size(); ++s) {
    const evaluate::StreamCounts& c = counts.streams[s];
    const double rate = elapsed_s > 0.0 ? static_cast<double>(c.received - received_[s]) / elapsed_s : 0.0;
    received_[s] = c.received;
    failures += c.dropped + c.late + c.lost + c.duplicate + c.undecodable;
    status.addf(options.streams[s],
                "%.1f images/s, %zu received, %zu dropped, %zu late, %zu lost, %zu duplicate, %zu unusable",
                rate, c.received, c.dropped, c.late, c.lost, c.duplicate, c.undecodable);
  }
  std::size_t not_evaluated = 0;
  for (const evaluate::PairCounts& pair : counts.pairs) not_evaluated += pair.notEvaluated();
  status.add("pairs that could not be evaluated", not_evaluated);
  status.add("images after the end", counts.after_end);
  using Status = diagnostic_msgs::DiagnosticStatus;
  if (counts.after_end > 0) {
    status.summaryf(Status::WARN, "%zu images came after the end, and were left out", counts.after_end);
  } else if (failures + not_evaluated > 0) {
    status.summaryf(Status::WARN,
                    "%zu images dropped, late, lost, duplicate or unusable; %zu pairs could not be evaluated",
                    failures, not_evaluated);
  } else if (const std::string unheard = intake_.unheardStreams(); !unheard.empty()) {
    status.summary(Status::WARN, "nobody publishes images of " + unheard);
  } else if (const std::string truth = counts.awaits_truth ? intake_.unheardTruth() : ""; !truth.empty()) {
    status.summary(Status::WARN, "nobody publishes " + truth + ", which " +
                                     std::to_string(counts.waiting_images) + " images wait for");
  } else {
    status.summaryf(Status::OK, "%zu poses evaluated", counts.evaluatedPoses());
  }
}

}  // namespace sunlit::ros_interface
