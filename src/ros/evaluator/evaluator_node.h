/// evaluator_node: see README.md and config/evaluator.yaml.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/service_server.h>
#include <ros/subscriber.h>
#include <sensor_msgs/Image.h>
#include <std_srvs/Trigger.h>

#include <memory>
#include <vector>

#include "ros/evaluator/evaluator_options.h"
#include "ros/evaluator/folder_lock.h"
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
  void subscribe(std::size_t stream);
  void onImage(std::size_t stream, const sensor_msgs::Image& message);
  void onPairDone(const evaluate::PairRecord& record, const cv::Mat& a, const cv::Mat& b);
  bool onFinish(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool isIdle() const;
  void finish(const std::string& reason);

  ros::NodeHandle node_;
  EvaluatorOptions options_;
  FolderLock lock_;  // before the evaluation, which mends an unfinished run as it starts
  ros::Publisher pair_difference_;
  ros::Publisher summary_;
  ros::Publisher progress_;
  ros::Publisher matches_image_;
  std::unique_ptr<evaluate::Evaluation> evaluation_;  // calls the publishers above until it ends
  std::vector<ros::Subscriber> subscribers_;
  ros::ServiceServer finish_;
  ProgressLog log_;
  ros::SteadyTime last_image_ = ros::SteadyTime::now();
  bool is_finished_ = false;
  bool is_finish_wanted_ = false;
  int status_ = 0;
};

}  // namespace sunlit::ros_interface
