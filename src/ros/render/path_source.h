/// The camera poses of a run, with their indices and stamps.
#pragma once

#include <nav_msgs/Path.h>
#include <ros/message_event.h>
#include <ros/node_handle.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "ros/render/options.h"

namespace sunlit::ros_interface {

/// Stamp of pose `index`: start + index / frame_rate, to the nanosecond, whatever came before.
ros::Time stampOfPose(const ros::Time& start, int index, double frame_rate);

/// Poses from a file, a topic or the built-in path.
class PathSource {
 public:
  /// A file or the built-in path is there at once; a topic's comes with its first message that is a path.
  /// Throws what path.h throws, and std::invalid_argument where `first` and `count` ask for more than the
  /// path has.
  PathSource(ros::NodeHandle node, const PathSourceOptions& options, const std::string& map_frame);

  bool ready() const { return !map_from_camera_.empty(); }
  /// The topic that the path is expected from; empty where it comes from elsewhere.
  std::string topic() const { return subscriber_ ? subscriber_.getTopic() : std::string(); }

  /// map_from_camera_link of pose `index`, 0 ≤ index < size().
  const Eigen::Isometry3d& mapFromCamera(int index) const {
    return map_from_camera_[static_cast<std::size_t>(index)];
  }
  /// As path::motionAt(), at the speed that the options ask for.
  Motion motionAt(int index, double frame_rate) const;
  /// As path::driveOf().
  std::string drive() const { return path::driveOf(options_.sampling); }
  /// Tells paths apart by all their poses; 16 hexadecimal digits.
  std::string fingerprint() const;
  /// Warns where none of the poses to render is near a world of these bounds (m in `map`), by
  /// studio::isFarFrom(): the path may be of another frame.
  void warnIfFarFrom(const Eigen::AlignedBox3d& bounds, double far_m) const;
  int size() const { return static_cast<int>(map_from_camera_.size()); }
  /// The indices to render are first(), first() + stride(), … below end().
  int first() const { return options_.selection.first; }
  int stride() const { return options_.selection.stride; }
  int end() const { return options_.selection.end(size()); }

 private:
  /// Refuses what cannot be driven along with an error, and goes on waiting: whoever sent it may send
  /// another. Of another path, once there is one, it only warns.
  void onPath(const ros::MessageEvent<const nav_msgs::Path>& event);
  void refusePath(const std::string& reason);
  void sample(const path::Waypoints& waypoints);

  PathSourceOptions options_;
  std::string map_frame_;  ///< that a path on a topic must speak of
  std::vector<Eigen::Isometry3d> map_from_camera_;
  ros::Subscriber subscriber_;
  path::Waypoints sent_;           ///< by the topic, as they came
  std::string refused_for_;        ///< the latest path, if it was refused
  bool is_other_told_of_ = false;  ///< another path, which is not heeded
};

}  // namespace sunlit::ros_interface
