#include "ros/render/path_source.h"

#include <ros/console.h>

#include <cmath>
#include <stdexcept>

#include "sunlit/scene/content_hash.h"
#include "sunlit/scene/race_track.h"

namespace sunlit::ros_interface {

ros::Time stampOfPose(const ros::Time& start, int index, double frame_rate) {
  constexpr std::int64_t kNanosecondsPerSecond = 1000000000;
  // Split, so that a long run at a high rate keeps its nanoseconds.
  const double seconds = static_cast<double>(index) / frame_rate;
  const double whole_seconds = std::floor(seconds);
  const auto rest = static_cast<std::int64_t>(std::llround((seconds - whole_seconds) * 1e9));
  ros::Time stamp;
  stamp.fromNSec(
      start.toNSec() +
      static_cast<std::uint64_t>(static_cast<std::int64_t>(whole_seconds) * kNanosecondsPerSecond + rest));
  return stamp;
}

PathSource::PathSource(ros::NodeHandle node, const PathSourceOptions& options, const std::string& map_frame)
    : options_(options), map_frame_(map_frame) {
  if (!options_.topic.empty()) {
    subscriber_ = node.subscribe(options_.topic, 1, &PathSource::onPath, this);
  } else if (!options_.file.empty()) {
    sample(path::readWaypoints(options_.file));
  } else {
    sample(scene::raceTrackWaypoints());
  }
}

std::string PathSource::fingerprint() const {
  scene::ContentHash print;
  for (const Eigen::Isometry3d& pose : map_from_camera_)
    print.add(std::vector<double>(pose.data(), pose.data() + pose.matrix().size()));
  return print.text();
}

void PathSource::onPath(const nav_msgs::Path& message) {
  if (ready()) return;  // the path of a run does not change under way
  path::Waypoints waypoints;
  for (const geometry_msgs::PoseStamped& stamped : message.poses) {
    waypoints.emplace_back(stamped.pose.position.x, stamped.pose.position.y, stamped.pose.position.z);
  }
  try {
    if (!message.header.frame_id.empty() && message.header.frame_id != map_frame_) {
      throw std::invalid_argument("its frame_id is \"" + message.header.frame_id + "\", but must be \"" +
                                  map_frame_ + '"');
    }
    sample(waypoints);
  } catch (const std::invalid_argument& error) {
    if (error.what() == refused_for_) return;  // planners send the same again and again
    refused_for_ = error.what();
    ROS_ERROR("Refused the path on %s: %s", subscriber_.getTopic().c_str(), error.what());
  }
}

void PathSource::sample(const path::Waypoints& waypoints) {
  map_from_camera_ = path::posesAlong(waypoints, options_.sampling);
  if (options_.first >= size() || end() > size()) {
    const int poses = size();
    map_from_camera_.clear();
    throw std::invalid_argument("path/first " + std::to_string(options_.first) + " and path/count " +
                                std::to_string(options_.count) + " ask for more than the path's " +
                                std::to_string(poses) + " poses");
  }
}

}  // namespace sunlit::ros_interface
