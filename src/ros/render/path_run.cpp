#include <ros/console.h>

#include <algorithm>
#include <optional>

#include "ros/conversions/time.h"
#include "ros/render/run.h"

namespace sunlit::ros_interface {

PathRun::PathRun(ros::NodeHandle node, const PacingOptions& options, const Parts& parts)
    : options_(options),
      path_(parts.path),
      streams_(parts.streams),
      robot_(parts.robot),
      clock_(parts.clock),
      pacer_(node, options.wait_for, options.max_ahead) {
  if (robot_ && robot_->jointsByTf()) tf_ = std::make_unique<TfInput>();
}

std::string PathRun::missing() {
  if (!path_.ready()) return "a path on " + path_.topic();
  if (ros::Time::now().isZero()) return "a time on /clock, by which /use_sim_time tells all nodes to go";
  std::string missing = streams_.waitsForSky();
  if (missing.empty() && !pacer_.connected()) missing = "progress on " + pacer_.silentTopic();
  if (missing.empty() && tf_ && !robot_->knowsJoints(tf_->buffer)) missing = robot_->waitsFor();
  if (missing.empty()) missing = streams_.waitsForSubscribers();
  return missing;
}

void PathRun::announce() {
  if (announced_ || !path_.ready()) return;
  if (start_.isZero() && options_.start_stamp_s) setStart(ros::Time(*options_.start_stamp_s));
  // Who hears where this run stands may let the sky move on, and what moved before all of its topics were
  // heard once is lost.
  if (!streams_.waitsForSky().empty()) return;
  announced_ = true;
  const int stride = path_.stride();
  position_ = (options_.resume_at + stride - 1) / stride * stride;
  // Two runs of one path, every pose and every n-th (counting the skipped), that both wait for one reader,
  // and the first for the second too, never wait in a ring, whatever stride and max_ahead are: the one that
  // is behind is held up by nobody but the reader, who has, or will have, all poses before the one where it
  // stands. But the first must know where the second stands, and not only once it has rendered something:
  // where it goes on, it may have nothing left to render, or be held up until the reader has come nearer to
  // its next pose.
  streams_.poseOutput().publishProgress(position());
}

void PathRun::setStart(const ros::Time& start) {
  start_ = start;
  streams_.poseOutput().publishPath(path_, start_, options_.frame_rate);
}

ros::Time PathRun::startOfNow() const {
  // The first pose to be rendered is to be that of now, and stamps are those of the whole path. But a sky
  // that moves, by a clock ahead of ours or while time stands still, may have nothing for now any more.
  ros::Time first = ros::Time::now();
  if (streams_.missedSky(first)) first = streams_.newestSky();
  const int index = path_.first() + position_;
  const auto now = static_cast<std::int64_t>(first.toNSec());
  const std::int64_t ahead = path::nanosecondsTo(index, options_.frame_rate);
  ros::Time start;
  start.fromNSec(static_cast<std::uint64_t>(std::max<std::int64_t>(now - ahead, 1)));
  if (now <= ahead)
    ROS_WARN(
        "start_stamp is now, %s, but no stamp is before 0: by frame_rate pose %d comes at %s at the earliest",
        textOfStamp(first).c_str(), index,
        textOfStamp(stampOfPose(start, index, options_.frame_rate)).c_str());
  return start;
}

// Of a simulation that is reset, or a bag that is played again. Less than a pose is no more than a wait. The
// wall's clock is set right by seconds: a wait, too, and where readers set the pace not even that.
void PathRun::heedClock() {
  constexpr double kSetRight_s = 10.0;
  const ros::Time now = ros::Time::now();
  const ros::Time before = seen_;
  seen_ = now;
  const bool is_wall = !ros::Time::isSimTime();
  if (clock_ != nullptr || (is_wall && !options_.wait_for.empty())) return;
  const double pose_s = 1.0 / options_.frame_rate;
  if (secondsFrom(now, before) <= (is_wall ? std::max(pose_s, kSetRight_s) : pose_s)) return;
  const bool is_told = !set_back_from_.isZero();
  set_back_from_ = before;
  if (is_told) return;
  ROS_WARN("The clock was set back from %s to %s: %s", textOfStamp(before).c_str(), textOfStamp(now).c_str(),
           options_.start_stamp_s
               ? "start_stamp stands, so that the next pose waits until that time comes again"
               : "start_stamp is now, so that the path goes on by stamps of that time");
}

// For a moment its sky is still that of before.
Step PathRun::beginAnew() {
  waits_for_ = streams_.waitsForSky();
  if (!waits_for_.empty()) return Step::kWaits;
  const ros::Time now = ros::Time::now();
  const ros::Time sky = streams_.newestSky();
  if (streams_.missedSky(now) && secondsFrom(now, sky) > secondsFrom(sky, set_back_from_)) {
    waits_for_ = std::string("a sky of the time to which the clock was set back");
    return Step::kWaits;
  }
  set_back_from_ = ros::Time();
  next_.reset();
  if (tf_) tf_->buffer.clear();
  setStart(startOfNow());
  return Step::kWaits;
}

bool PathRun::isTime(const ros::Time& stamp) {
  if (clock_ != nullptr) {
    clock_->advanceTo(stamp);
    return true;
  }
  // Readers that are waited for set the pace; without any, time does.
  return !options_.wait_for.empty() || ros::Time::now() >= stamp;
}

bool PathRun::begin() {
  waits_for_ = missing();
  if (!waits_for_.empty()) return false;
  if (position_ > 0) ROS_INFO("Going on at pose %d", path_.first() + position_);
  return true;
}

RobotPlaces::Joints PathRun::joints() const {
  return tf_ ? robot_->joints(tf_->buffer) : RobotPlaces::Joints();
}

Shot PathRun::shotAt(int position, const RobotPlaces::Joints& joints) const {
  const int index = path_.first() + position;
  Shot shot{index, stampOfPose(start_, index, options_.frame_rate), path_.mapFromCamera(index)};
  shot.chance = index;
  shot.drive = path_.drive();
  shot.motion = path_.motionAt(index, options_.frame_rate);
  if (robot_) shot.map_from_links = robot_->onPath(shot.map_from_camera, joints);
  return shot;
}

render::BodyPlaces PathRun::mapFromLinks() {
  return map_from_links_.empty() && path_.ready() ? shotAt(0, joints()).map_from_links : map_from_links_;
}

int PathRun::counted(int position) const {
  const int stride = options_.counts_skipped ? 1 : path_.stride();
  return (position + stride - 1) / stride;
}

RunProgress PathRun::progress() const {
  const auto poses = [&](int positions) { return (positions + path_.stride() - 1) / path_.stride(); };
  RunProgress progress;
  if (!path_.ready()) return progress;
  progress.done = poses(position());
  progress.to_do = poses(positions()) - progress.done;
  if (!options_.wait_for.empty()) progress.ahead = counted(position()) - pacer_.slowest();
  return progress;
}

bool PathRun::metersBefore(const Shot& shot) {
  // What a run that began earlier, or passes over fewer poses, has metered, under the sky that is there.
  const auto index = static_cast<int>(streams_.firstUnmetered(shot.pose_index));
  if (index == shot.pose_index) return false;
  const std::string wanted = "an exposure that lags to meter ", before = std::to_string(shot.pose_index);
  waits_for_ = {wanted + "poses " + std::to_string(index) + " to " + std::to_string(shot.pose_index - 1) +
                    " before pose " + before,
                wanted + "what is before pose " + before};
  streams_.meter(shotAt(index - path_.first(), joints()), shot);
  return true;
}

Step PathRun::render() {
  if (!next_) next_ = shotAt(position_, {});
  waits_for_ = Wait();
  waits_set_back_ = !set_back_from_.isZero();
  if (!isTime(next_->stamp)) {
    waits_for_ = time_wait_.until(next_->stamp, "pose " + std::to_string(next_->pose_index),
                                  ros::Duration(1.0 / options_.frame_rate));
    return Step::kWaits;
  }
  waits_for_ = streams_.waitsForSky(next_->stamp);
  if (!waits_for_.empty()) return Step::kWaits;
  waits_set_back_ = false;
  set_back_from_ = ros::Time();
  if (metersBefore(*next_)) return Step::kMetered;
  Shot shot = *next_;
  if (tf_) {
    // Not earlier: they move while the pose waits for its time, its sky and its readers.
    const RobotPlaces::Joints found = joints();
    robot_->count(found);
    shot = shotAt(position_, found);
  }
  map_from_links_ = shot.map_from_links;
  position_ += path_.stride();
  next_.reset();
  if (options_.looks_ahead && !tf_ && position_ < positions()) next_ = shotAt(position_, {});
  streams_.take(shot, next_);
  streams_.poseOutput().publishProgress(position());
  return Step::kTook;
}

Step PathRun::step() {
  heedClock();
  waits_set_back_ = false;
  if (!set_back_from_.isZero() && !options_.start_stamp_s && position_ < positions()) return beginAnew();
  if (start_.isZero()) setStart(startOfNow());
  if (position_ >= positions()) {
    if (pacer_.allHave(counted(positions()))) return Step::kDone;
  } else if (pacer_.mayRender(counted(position_))) {
    return render();
  }
  // A reader that makes progress, however slowly, is no reason to wonder: where it stands is part of the key.
  waits_for_ =
      "progress on " + pacer_.slowestTopic() + ", which stands at " + std::to_string(pacer_.slowest());
  return Step::kWaits;
}

}  // namespace sunlit::ros_interface
