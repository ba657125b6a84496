#include "ros/evaluator/bag_trajectory.h"

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <rosbag/view.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "ros/conversions/geometry.h"
#include "ros/conversions/received_images.h"
#include "ros/conversions/time.h"
#include "ros/evaluator/bag_topics.h"
#include "ros/evaluator/pose_frames.h"

namespace sunlit::ros_interface {
namespace {

using evaluate::StampedPose;
using evaluate::Trajectory;

struct NamedTopic {
  std::string bag;
  std::string topic;  ///< empty: not said
};

NamedTopic namedTopic(const std::string& named) {
  const std::size_t colon = named.rfind(".bag:");
  if (colon == std::string::npos || std::filesystem::exists(named)) return {named, ""};
  return {named.substr(0, colon + 4), withSlash(named.substr(colon + 5))};
}

geometry_msgs::Pose poseOf(const geometry_msgs::Transform& transform) {
  geometry_msgs::Pose pose;
  pose.position.x = transform.translation.x;
  pose.position.y = transform.translation.y;
  pose.position.z = transform.translation.z;
  pose.orientation = transform.rotation;
  return pose;
}

template <typename Message>
std::string typeOf() {
  return ros::message_traits::DataType<Message>::value();
}

bool bringsPoses(const std::string& type) {
  return typesOfPoses().count(type) > 0 || type == typeOf<nav_msgs::Path>();
}

/// The one that was named, or the only one of poses.
std::string topicIn(const rosbag::Bag& bag, const NamedTopic& named) {
  std::map<std::string, std::string> found;  // types by topic
  for (const auto& [topic, type] : typesOfTopics(bag)) {
    if (topic == named.topic || bringsPoses(type)) found.emplace(topic, type);
  }
  if (!named.topic.empty() && found.count(named.topic) > 0) return named.topic;
  if (named.topic.empty() && found.size() == 1) return found.begin()->first;
  std::string listed;
  for (const auto& [topic, type] : found) listed += (listed.empty() ? "" : ", ") + topic + " (" + type + ")";
  if (found.empty()) throw std::runtime_error(named.bag + ": holds no topic of poses");
  throw std::runtime_error(named.bag + ": " +
                           (named.topic.empty()
                                ? "say which topic, as in " + named.bag + ":" + found.begin()->first
                                : "holds no topic " + named.topic) +
                           "; topics of poses are: " + listed);
}

/// Nothing, and noted, where it is unusable.
std::optional<StampedPose> stampedPoseOf(const PoseMessage& message, const std::string& topic,
                                         LeftOutPoses* left_out) {
  try {
    const Eigen::Isometry3d pose = fromPose(message.pose);
    return StampedPose{message.stamp_ns, pose.translation(), Eigen::Quaterniond(pose.linear())};
  } catch (const std::invalid_argument& error) {
    if (left_out->unusable++ == 0)
      left_out->first_unusable = topic + " at " + textOfStamp(timeOf(message.stamp_ns)) + ": " + error.what();
    return std::nullopt;
  }
}

std::vector<PoseMessage> messagesOf(const nav_msgs::Path& path) {
  std::vector<PoseMessage> messages;
  for (const geometry_msgs::PoseStamped& pose : path.poses)
    messages.push_back({nanosecondsOf(pose.header.stamp), pose.pose, pose.header.frame_id, ""});
  return messages;
}

std::vector<PoseMessage> messagesIn(const rosbag::Bag& bag, const std::string& topic) {
  std::vector<PoseMessage> messages;
  rosbag::View view(bag, topicQuery({topic}));
  for (const rosbag::MessageInstance& instance : view) {
    if (const auto path = instance.instantiate<nav_msgs::Path>()) {
      messages = messagesOf(*path);
    } else {
      messages.push_back(poseMessageOf(instance));
    }
  }
  return messages;
}

}  // namespace

const std::set<std::string>& typesOfPoses() {
  static const std::set<std::string> types = {
      typeOf<geometry_msgs::PoseStamped>(), typeOf<geometry_msgs::PoseWithCovarianceStamped>(),
      typeOf<geometry_msgs::TransformStamped>(), typeOf<nav_msgs::Odometry>()};
  return types;
}

PoseMessage poseMessageOf(const rosbag::MessageInstance& instance) {
  const auto made = [](const std_msgs::Header& header, const geometry_msgs::Pose& pose,
                       const std::string& body = "") {
    return PoseMessage{nanosecondsOf(header.stamp), pose, header.frame_id, body};
  };
  if (const auto message = instance.instantiate<geometry_msgs::PoseStamped>())
    return made(message->header, message->pose);
  if (const auto message = instance.instantiate<geometry_msgs::PoseWithCovarianceStamped>())
    return made(message->header, message->pose.pose);
  if (const auto message = instance.instantiate<nav_msgs::Odometry>())
    return made(message->header, message->pose.pose, message->child_frame_id);
  if (const auto message = instance.instantiate<geometry_msgs::TransformStamped>())
    return made(message->header, poseOf(message->transform), message->child_frame_id);
  throw std::runtime_error(instance.getTopic() + " is " + instance.getDataType() +
                           ", not geometry_msgs/PoseStamped, PoseWithCovarianceStamped or TransformStamped, "
                           "nor nav_msgs/Odometry");
}

bool isOfBag(const std::string& named) {
  return std::filesystem::path(namedTopic(named).bag).extension() == ".bag";
}

Trajectory readBagTrajectory(const std::string& named, LeftOutPoses* left_out) {
  const NamedTopic chosen = namedTopic(named);
  const std::unique_ptr<rosbag::Bag> bag = openBag(chosen.bag);
  const std::string topic = topicIn(*bag, chosen);
  std::vector<PoseMessage> messages;
  readingBag(chosen.bag, [&] { messages = messagesIn(*bag, topic); });
  if (messages.empty()) throw std::runtime_error(chosen.bag + ": " + topic + " holds no pose");
  std::stable_sort(messages.begin(), messages.end(),
                   [](const PoseMessage& a, const PoseMessage& b) { return a.stamp_ns < b.stamp_ns; });
  Trajectory trajectory;
  PoseFrames frames;
  PoseBody body;
  for (const PoseMessage& message : messages) {
    body.require(message.body, {topic, chosen.bag});
    const std::optional<StampedPose> pose = stampedPoseOf(message, topic, left_out);
    if (!pose) continue;
    if (std::string warning = frames.note(message.frame, topic + " of " + chosen.bag); !warning.empty())
      left_out->of_frames.push_back(std::move(warning));
    if (trajectory.empty() || pose->stamp_ns != trajectory.back().stamp_ns) {
      trajectory.push_back(*pose);
    } else {
      left_out->repeated.push_back(pose->stamp_ns);
    }
  }
  if (trajectory.empty())
    throw std::runtime_error(chosen.bag + ": holds no usable pose; " + std::to_string(left_out->unusable) +
                             " cannot be used, the first is " + left_out->first_unusable);
  return trajectory;
}

}  // namespace sunlit::ros_interface
