#include <algorithm>
#include <optional>

#include "ros/render/run.h"

namespace sunlit::ros_interface {

PathRun::PathRun(ros::NodeHandle node, const PacingOptions& options, const PathSource& path, Streams& streams)
    : options_(options), path_(path), streams_(streams), pacer_(node, options.wait_for, options.max_ahead) {}

std::string PathRun::missing() const {
  if (!path_.ready()) return "a path on " + path_.topic();
  if (start_.isZero()) return "a time on /clock";
  std::string missing = streams_.waitsForSun();
  if (missing.empty() && !pacer_.connected()) missing = "progress on " + pacer_.silentTopic();
  if (missing.empty()) missing = streams_.waitsForSubscribers();
  return missing;
}

void PathRun::announce() {
  if (!path_.ready() || !start_.isZero()) return;
  start_ = options_.start_stamp_s ? ros::Time(*options_.start_stamp_s) : ros::Time::now();
  if (start_.isZero()) return;  // simulation time has not begun
  streams_.poseOutput().publishPath(path_, start_, options_.frame_rate);
  streams_.poseOutput().publishProgress(0);
}

bool PathRun::begin() {
  if (began_) return true;
  waits_for_ = missing();
  if (!waits_for_.empty()) return false;
  const int stride = path_.stride();
  position_ = (options_.resume_at + stride - 1) / stride * stride;
  if (position_ > 0) ROS_INFO("Going on at pose %d", path_.first() + position_);
  began_ = true;
  return true;
}

Step PathRun::step() {
  if (!begin()) return Step::kWaits;
  if (position_ >= positions()) {
    if (pacer_.allHave(positions())) return Step::kDone;
  } else if (pacer_.mayRender(position_)) {
    const int index = path_.first() + position_;
    position_ += path_.stride();
    std::optional<Eigen::Isometry3d> next;
    if (position_ < positions()) next = path_.mapFromCamera(path_.first() + position_);
    streams_.take({index, stampOfPose(start_, index, options_.frame_rate), path_.mapFromCamera(index)}, next);
    streams_.poseOutput().publishProgress(std::min(position_, positions()));
    return Step::kTook;
  }
  waits_for_ =
      "progress on " + pacer_.slowestTopic() + ", which stands at " + std::to_string(pacer_.slowest());
  return Step::kWaits;
}

}  // namespace sunlit::ros_interface
