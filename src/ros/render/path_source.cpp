#include "ros/render/path_source.h"

#include <ros/console.h>

#include <stdexcept>
#include <utility>

#include "sunlit/image/content_hash.h"
#include "sunlit/scene/race_track.h"

namespace sunlit::ros_interface {

ros::Time stampOfPose(const ros::Time& start, int index, double frame_rate) {
  ros::Time stamp;
  stamp.fromNSec(start.toNSec() + static_cast<std::uint64_t>(path::nanosecondsTo(index, frame_rate)));
  return stamp;
}

PathSource::PathSource(ros::NodeHandle node, const PathSourceOptions& options, const std::string& map_frame)
    : options_(options), map_frame_(map_frame) {
  if (!options_.topic.empty()) {
    subscriber_ = node.subscribe(options_.topic, 1, &PathSource::onPath, this);
  } else if (!options_.file.empty()) {
    sample(path::readWaypoints(options_.file, [](const std::string& line) { ROS_INFO("%s", line.c_str()); }));
  } else {
    sample(scene::raceTrackWaypoints());
  }
}

Motion PathSource::motionAt(int index, double frame_rate) const {
  return path::motionAt(map_from_camera_, index,
                        {frame_rate, options_.speed_m_s, options_.sampling.spacing_m});
}

std::string PathSource::fingerprint() const {
  image::ContentHash print;
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
  std::vector<Eigen::Isometry3d> poses = path::posesAlong(waypoints, options_.sampling);
  path::requireWithin(options_.selection, static_cast<int>(poses.size()), "path/");
  map_from_camera_ = std::move(poses);
}

}  // namespace sunlit::ros_interface
