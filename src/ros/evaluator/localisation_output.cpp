#include "ros/evaluator/localisation_output.h"

#include <geometry_msgs/PoseWithCovarianceStamped.h>

#include "ros/conversions/evaluation.h"
#include "sunlit/ros/topic_names.h"

namespace sunlit::ros_interface {
namespace {

constexpr std::uint32_t kOutputQueue = 100;
constexpr double kLineWidth_m = 0.1;
constexpr double kFailureSize_m = 0.6;

std_msgs::ColorRGBA colour(float red, float green, float blue) {
  std_msgs::ColorRGBA colour;
  colour.r = red;
  colour.g = green;
  colour.b = blue;
  colour.a = 1.0F;
  return colour;
}

visualization_msgs::Marker marker(const std::string& name_space, int type, double width_m) {
  visualization_msgs::Marker marker;
  marker.ns = name_space;
  marker.type = type;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  marker.scale.x = marker.scale.y = marker.scale.z = width_m;
  return marker;
}

}  // namespace

LocalisationOutput::LocalisationOutput(ros::NodeHandle private_node,
                                       const evaluate::EvaluationOptions& options)
    : is_used_(!options.localisation.map.empty()) {
  if (!is_used_) return;
  queries_ = private_node.advertise<Localisation>(topics::kLocalisation, kOutputQueue);
  summary_ = private_node.advertise<LocalisationSummary>(topics::kLocalisationSummary, 1, true);
  markers_ = private_node.advertise<visualization_msgs::MarkerArray>(topics::kLocalisationMarkers, 1, true);
  for (const std::string& query : queriesOf(options)) {
    for (const std::string& detector : localisingDetectors(options.localisation, options.comparer)) {
      poses_[{query, detector}] = private_node.advertise<geometry_msgs::PoseWithCovarianceStamped>(
          std::string(topics::kLocalisation) + "/" + query + "/" + detector + "/pose", kOutputQueue);
    }
  }
  drawn_.markers = {marker("truth", visualization_msgs::Marker::POINTS, kLineWidth_m),
                    marker("estimate", visualization_msgs::Marker::LINE_LIST, kLineWidth_m),
                    marker("failures", visualization_msgs::Marker::POINTS, kFailureSize_m)};
  drawn_.markers[0].color = colour(0.9F, 0.9F, 0.9F);
  drawn_.markers[1].color = colour(0.0F, 0.62F, 0.45F);
  drawn_.markers[2].color = colour(0.84F, 0.37F, 0.0F);
}

void LocalisationOutput::setFrame(const std::string& frame) {
  frame_ = frame;
}

// A line from the truth to the estimate; a point where there is none.
void LocalisationOutput::publish(const evaluate::LocalisationRow& row) {
  const Localisation message = messageOf(row, frame_);
  queries_.publish(message);
  drawn_.markers[0].points.push_back(message.truth.position);
  if (row.result.status != evaluate::LocalisationStatus::kLocalised) {
    drawn_.markers[2].points.push_back(message.truth.position);
    return;
  }
  drawn_.markers[1].points.push_back(message.truth.position);
  drawn_.markers[1].points.push_back(message.estimate.pose.position);
  geometry_msgs::PoseWithCovarianceStamped pose;
  pose.header = message.header;
  pose.pose = message.estimate;
  poses_.at({row.query, row.detector}).publish(pose);
}

void LocalisationOutput::publish(const std::vector<evaluate::LocalisationSummary>& summary) {
  if (!is_used_) return;
  LocalisationSummary message = messageOf(summary);
  message.header.stamp = ros::Time::now();
  summary_.publish(message);
  visualization_msgs::MarkerArray shown = drawn_;  // of no points RViz would complain
  shown.markers.clear();
  for (visualization_msgs::Marker& one : drawn_.markers) {
    one.header.frame_id = frame_;
    one.header.stamp = message.header.stamp;
    if (!one.points.empty()) shown.markers.push_back(one);
  }
  markers_.publish(shown);
}

}  // namespace sunlit::ros_interface
