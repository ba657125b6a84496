#include "ros/render/path_source.h"

#include <ros/console.h>
#include <ros/this_node.h>

#include <stdexcept>
#include <utility>

#include "ros/render/input_log.h"
#include "sunlit/image/content_hash.h"
#include "sunlit/quantity/range.h"
#include "sunlit/scene/race_track.h"

namespace sunlit::ros_interface {

namespace {

path::Waypoints waypointsOf(const nav_msgs::Path& message) {
  path::Waypoints waypoints;
  for (const geometry_msgs::PoseStamped& stamped : message.poses) {
    waypoints.emplace_back(stamped.pose.position.x, stamped.pose.position.y, stamped.pose.position.z);
  }
  return waypoints;
}

/// Throws std::invalid_argument where the path, or one of its poses, names another frame than `map_frame`.
/// Many planners name none in the poses.
void requireFrames(const nav_msgs::Path& message, const std::string& map_frame) {
  const auto require = [&](const std::string& frame, const std::string& owner) {
    if (!frame.empty() && frame != map_frame)
      refuse(owner + "frame_id", '"' + frame + '"', '"' + map_frame + '"');
  };
  require(message.header.frame_id, "its ");
  for (std::size_t i = 0; i < message.poses.size(); ++i)
    require(message.poses[i].header.frame_id, "waypoint " + std::to_string(i) + ": its ");
}

}  // namespace

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

void PathSource::warnIfFarFrom(const Eigen::AlignedBox3d& bounds, double far_m) const {
  for (int index = first(); index < end(); index += stride())
    if (!studio::isFarFrom(bounds, mapFromCamera(index).translation(), far_m)) return;
  const std::string path = options_.file.empty() ? "the path on " + topic() : options_.file;
  ROS_LOG(inputLevel(), ROSCONSOLE_DEFAULT_NAME,
          "No pose of %s is near the world, %s: is it in another frame?", path.c_str(),
          studio::reachOf(bounds).c_str());
}

void PathSource::onPath(const ros::MessageEvent<const nav_msgs::Path>& event) {
  if (event.getPublisherName() == ros::this_node::getName()) return;  // its poses, where the topic is `path`
  const nav_msgs::Path& message = *event.getConstMessage();
  const path::Waypoints sent = waypointsOf(message);
  if (ready()) {
    if (sent == sent_ || is_other_told_of_) return;
    is_other_told_of_ = true;
    ROS_WARN("Another path came on %s: it is not heeded, since the path of a run does not change under way",
             subscriber_.getTopic().c_str());
    return;
  }
  std::string left_out;
  try {
    requireFrames(message, map_frame_);
    const path::Waypoints waypoints = path::withoutStandstills(sent);
    if (waypoints.size() < sent.size()) left_out = path::leftOutText(sent.size() - waypoints.size());
    sample(waypoints);
  } catch (const std::invalid_argument& error) {
    refusePath(error.what() + (left_out.empty() ? "" : "; " + left_out));
    return;
  }
  sent_ = sent;
  if (!left_out.empty()) ROS_INFO("The path on %s: %s", subscriber_.getTopic().c_str(), left_out.c_str());
}

void PathSource::refusePath(const std::string& reason) {
  if (reason == refused_for_) return;  // planners send the same again and again
  refused_for_ = reason;
  ROS_ERROR("Refused the path on %s: %s", subscriber_.getTopic().c_str(), reason.c_str());
}

void PathSource::sample(const path::Waypoints& waypoints) {
  std::vector<Eigen::Isometry3d> poses = path::posesAlong(waypoints, options_.sampling);
  path::requireWithin(options_.selection, static_cast<int>(poses.size()), "path/");
  const std::string crowded = stride() > 1 ? "" : path::crowdedText(waypoints, options_.sampling);
  if (!crowded.empty()) ROS_LOG(inputLevel(), ROSCONSOLE_DEFAULT_NAME, "%s", crowded.c_str());
  map_from_camera_ = std::move(poses);
}

}  // namespace sunlit::ros_interface
