#include "ros/render/pose_output.h"

#include <nav_msgs/Path.h>
#include <std_msgs/UInt32.h>
#include <tf2_msgs/TFMessage.h>

#include "ros/render/messages.h"
#include "sunlit/quantity/frames.h"

namespace sunlit::ros_interface {

PoseOutput::PoseOutput(ros::NodeHandle node, ros::NodeHandle private_node, const PoseOutputOptions& options)
    : options_(options),
      depth_(node.advertise<sensor_msgs::Image>("camera/depth/image_raw", options.queue_size)),
      pose_(node.advertise<geometry_msgs::PoseStamped>("camera/pose", options.queue_size)),
      path_(node.advertise<nav_msgs::Path>("path", 1, true)),
      progress_(private_node.advertise<std_msgs::UInt32>("progress", 1, true)) {
  // A publisher of our own, and not a tf2_ros::TransformBroadcaster, for the sake of its queue and subscriber
  // count.
  if (options_.publish_tf) tf_ = node.advertise<tf2_msgs::TFMessage>("/tf", options.queue_size);
}

void PoseOutput::publishPath(const PathSource& path, const ros::Time& start, double frame_rate) const {
  nav_msgs::Path message;
  message.header.stamp = start;
  message.header.frame_id = kMapFrame;
  for (int index = 0; index < path.size(); ++index) {
    geometry_msgs::PoseStamped pose;
    pose.header.frame_id = kMapFrame;
    pose.header.stamp = stampOfPose(start, index, frame_rate);
    pose.pose = toPose(path.mapFromCamera(index));
    message.poses.push_back(pose);
  }
  path_.publish(message);
}

void PoseOutput::publish(const Eigen::Isometry3d& map_from_camera, const image::DepthImage& depth,
                         const ros::Time& stamp) const {
  geometry_msgs::PoseStamped pose;
  pose.header.stamp = stamp;
  pose.header.frame_id = kMapFrame;
  pose.pose = toPose(map_from_camera);
  if (options_.publish_tf) {
    tf2_msgs::TFMessage transforms;
    const bool follows = !options_.followed_frame.empty();
    const std::string link = follows ? options_.followed_frame : kCameraFrame;
    if (!follows) transforms.transforms.push_back(toTransform(map_from_camera, kMapFrame, link, stamp));
    transforms.transforms.push_back(
        toTransform(Eigen::Isometry3d(linkFromOptical()), link, kOpticalFrame, stamp));
    tf_.publish(transforms);
  }
  pose_.publish(pose);
  depth_.publish(sensor_msgs::ImageConstPtr(toImageMessage(depth, opticalHeader(stamp))));
}

void PoseOutput::publishProgress(int poses) const {
  std_msgs::UInt32 progress;
  progress.data = static_cast<std::uint32_t>(poses);
  progress_.publish(progress);
}

std::string PoseOutput::lonelyTopic(const WantedSubscribers& wanted) const {
  if (static_cast<int>(pose_.getNumSubscribers()) < wanted.poses) return pose_.getTopic();
  for (const ros::Publisher* publisher : {&depth_, &tf_}) {
    if (*publisher && static_cast<int>(publisher->getNumSubscribers()) < wanted.others)
      return publisher->getTopic();
  }
  return std::string();
}

}  // namespace sunlit::ros_interface
