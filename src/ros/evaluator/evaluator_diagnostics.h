/// What /diagnostics is told of an evaluation.
#pragma once

#include <vector>

#include "ros/evaluator/image_intake.h"
#include "ros/wall_updater.h"
#include "sunlit/evaluate/run/evaluation.h"

namespace sunlit::ros_interface {

/// Once a second: images a second and losses of each stream, backlog, progress, and what is waited for. A
/// warning once anything was dropped, lost or left out, or could not be used or evaluated, or came after the
/// end, and while nobody sends a stream.
class EvaluatorDiagnostics {
 public:
  /// Both outlive this.
  EvaluatorDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                       const evaluate::Evaluation& evaluation, const ImageIntake& intake);
  /// Publishes if it is time to.
  void update() { updater_.update(); }

 private:
  void tell(WallUpdater::Status& status);

  const evaluate::Evaluation& evaluation_;
  const ImageIntake& intake_;
  WallUpdater updater_;
  ros::SteadyTime last_ = ros::SteadyTime::now();
  std::vector<std::size_t> received_;  // until then, by stream
};

}  // namespace sunlit::ros_interface
