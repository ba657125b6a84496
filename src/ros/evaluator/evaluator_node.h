/// evaluator_node: see README.md and config/evaluator.yaml.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/service_server.h>
#include <std_srvs/Trigger.h>

#include <cstddef>
#include <exception>
#include <memory>
#include <mutex>
#include <string>

#include "ros/activity.h"
#include "ros/evaluator/evaluator_diagnostics.h"
#include "ros/evaluator/evaluator_options.h"
#include "ros/evaluator/folder_lock.h"
#include "ros/evaluator/image_intake.h"
#include "ros/evaluator/localisation_output.h"
#include "ros/evaluator/progress_log.h"

namespace sunlit::ros_interface {

/// Wires topics to an Evaluation.
class EvaluatorNode {
 public:
  EvaluatorNode(ros::NodeHandle node, ros::NodeHandle private_node, const EvaluatorOptions& options);
  ~EvaluatorNode();
  /// Serves callbacks until everything is evaluated, nothing comes any more, or ROS shuts down. The exit
  /// status of the process: 0 where every pair was evaluated (or is undefined), 3 where some could not be.
  int run();

 private:
  void publishProgress(std::size_t passed);
  void onPairDone(const evaluate::PairRecord& record, const cv::Mat& a, const cv::Mat& b);
  bool onFinish(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool isIdle() const;
  /// Why it is time to finish; empty while it is not.
  std::string reasonToFinish() const;
  void localise();
  void drawReport(const evaluate::Outcome& outcome);
  void compareMethods(bool is_broken_off);
  void finish(const std::string& reason);

  EvaluatorOptions options_;
  FolderLock lock_;  // before the evaluation, which mends an unfinished run as it starts
  ros::Publisher pair_difference_;
  ros::Publisher summary_;
  ros::Publisher progress_;
  std::mutex progress_mutex_;
  std::size_t passed_ = 0;  // as told
  ros::Publisher matches_image_;
  LocalisationOutput localisation_;
  ActivityOutput activity_;
  std::unique_ptr<evaluate::Evaluation> evaluation_;  // calls the publishers above until it ends
  std::unique_ptr<ImageIntake> intake_;
  std::unique_ptr<EvaluatorDiagnostics> diagnostics_;
  ros::ServiceServer finish_;
  ProgressLog log_;
  bool is_finished_ = false;
  bool has_warned_ = false;   // of images after the end
  std::exception_ptr fault_;  // that kept ~finish from writing
  std::string faults_;        // what could not be evaluated
  int status_ = 0;
};

}  // namespace sunlit::ros_interface
