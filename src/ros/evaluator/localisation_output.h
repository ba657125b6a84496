/// What localising finds, as messages: each query, the markers of all, and the summary.
#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <visualization_msgs/MarkerArray.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sunlit/evaluate/localise/localisation_files.h"
#include "sunlit/evaluate/run/evaluation_options.h"
#include "sunlit/ros/frame_names.h"

namespace sunlit::ros_interface {

/// ~localisation, for each query and detector ~localisation/<query>/<detector>/pose, ~localisation/markers
/// and, latched, ~localisation/summary.
class LocalisationOutput {
 public:
  /// Advertises where there is a map.
  LocalisationOutput(ros::NodeHandle private_node, const evaluate::EvaluationOptions& options);
  /// What `frame` the poses are in.
  void setFrame(const std::string& frame);
  void publish(const evaluate::LocalisationRow& row);
  void publish(const std::vector<evaluate::LocalisationSummary>& summary);

 private:
  bool is_used_;
  std::string frame_ = kMapFrame;
  ros::Publisher queries_;
  ros::Publisher summary_;
  ros::Publisher markers_;
  std::map<std::pair<std::string, std::string>, ros::Publisher> poses_;  ///< by query and detector
  visualization_msgs::MarkerArray drawn_;
};

}  // namespace sunlit::ros_interface
