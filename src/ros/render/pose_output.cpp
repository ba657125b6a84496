#include "ros/render/pose_output.h"

#include <nav_msgs/Path.h>
#include <std_msgs/UInt32.h>
#include <tf2_msgs/TFMessage.h>

#include "ros/conversions/geometry.h"
#include "ros/conversions/images.h"
#include "sunlit/ros/topic_names.h"

namespace sunlit::ros_interface {

PoseOutput::PoseOutput(ros::NodeHandle node, ros::NodeHandle private_node, const OutputOptions& options)
    : options_(options),
      depth_(node, topics::kDepth, options.queue_size),
      pose_(HeardTopic::of<geometry_msgs::PoseStamped>(node, topics::kPose, options.queue_size)),
      path_(node.advertise<nav_msgs::Path>(topics::kPath, 1, true)),
      progress_(private_node.advertise<std_msgs::UInt32>(topics::kProgress, 1, true)) {
  if (!options.publish_tf || options.follows_tf) return;
  // A publisher of our own, and not a tf2_ros::TransformBroadcaster, for the sake of its queue and subscriber
  // count.
  tf_ = HeardTopic::of<tf2_msgs::TFMessage>(node, topics::kTf, options.queue_size);
  optical_.emplace(options.frames, options.right).publish();
  watch_.emplace(node, options.frames.camera, options.frames.map,
                 "With publish_tf: false it is left to others; frames/camera calls it otherwise");
}

void PoseOutput::publishPath(const PathSource& path, const ros::Time& start, double frame_rate) const {
  nav_msgs::Path message;
  message.header = headerOf(options_.frames.map, start);
  for (int index = 0; index < path.size(); ++index) {
    geometry_msgs::PoseStamped pose;
    pose.header = headerOf(options_.frames.map, stampOfPose(start, index, frame_rate));
    pose.pose = toPose(path.mapFromCamera(index));
    message.poses.push_back(pose);
  }
  path_.publish(message);
}

void PoseOutput::publish(const Eigen::Isometry3d& map_from_camera, const image::DepthImage& depth,
                         const ros::Time& stamp) const {
  geometry_msgs::PoseStamped pose;
  pose.header = headerOf(options_.frames.map, stamp);
  pose.pose = toPose(map_from_camera);
  if (tf_) {
    tf2_msgs::TFMessage transforms;
    transforms.transforms.push_back(toTransform(map_from_camera, pose.header, options_.frames.camera));
    tf_->publisher.publish(transforms);
  }
  pose_.publisher.publish(pose);
  depth_.publish(depth, toCameraInfo(options_.camera, headerOf(options_.frames.optical, stamp)));
}

void PoseOutput::publishProgress(int poses) const {
  std_msgs::UInt32 progress;
  progress.data = static_cast<std::uint32_t>(poses);
  progress_.publish(progress);
}

std::string PoseOutput::lonelyTopic(const WantedSubscribers& wanted) const {
  std::string topic = pose_.ifLonely(wanted.audience(wanted.poses));
  if (topic.empty() && tf_) topic = tf_->ifLonely(wanted.audience(wanted.others));
  if (!topic.empty()) return topic;
  return depth_.lonelyTopic({wanted.audience(wanted.ofTruth()), wanted.audience(wanted.others)});
}

}  // namespace sunlit::ros_interface
