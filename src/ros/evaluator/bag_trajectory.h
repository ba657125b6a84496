/// Poses in bags, whatever messages bring them.
#pragma once

#include <geometry_msgs/Pose.h>
#include <rosbag/message_instance.h>

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "sunlit/evaluate/trajectory/trajectory.h"

namespace sunlit::ros_interface {

struct PoseMessage {
  std::int64_t stamp_ns = 0;
  geometry_msgs::Pose pose;
  std::string frame;  ///< that it stands in, as sent
  std::string body;   ///< that it is of, its child_frame_id; empty where the message has none
};

/// Of messages that bring a pose each, as bags call them.
const std::set<std::string>& typesOfPoses();

/// Of a geometry_msgs/PoseStamped, PoseWithCovarianceStamped or TransformStamped, or a nav_msgs/Odometry.
/// Throws std::runtime_error naming topic and type for another message.
PoseMessage poseMessageOf(const rosbag::MessageInstance& instance);

/// Poses that are there, but do not count, and what is doubtful about those that do.
struct LeftOutPoses {
  std::vector<std::int64_t> repeated;  ///< stamps that one before has, ns
  std::size_t unusable = 0;            ///< not finite, or of a quaternion that is not of unit length
  std::string first_unusable;          ///< by topic and stamp, and why
  std::vector<std::string> of_frames;  ///< lines that warn of each frame beside the first; its poses count
};

/// What a bag's topic says: a message a pose, as above, or the last nav_msgs/Path, which SLAM systems send
/// anew as it grows. By rising stamp; unusable poses, such as systems send before they know where they are,
/// are left out, and of those of one stamp the first counts. `left_out` tells of the others.
///
/// `named` is "BAG" or "BAG:TOPIC"; without a topic the only one that brings poses. Throws std::runtime_error
/// for a bag that cannot be read, a topic that it does not hold, several where none was named (all are
/// listed), and no usable pose.
evaluate::Trajectory readBagTrajectory(const std::string& named, LeftOutPoses* left_out);

/// As readBagTrajectory() takes it: ends in ".bag", or in ".bag:" and a topic.
bool isOfBag(const std::string& named);

}  // namespace sunlit::ros_interface
