#include <ros/console.h>
#include <tf2/exceptions.h>

#include <algorithm>

#include "ros/render/run.h"

namespace sunlit::ros_interface {

namespace {

/// How long one moment of the frame is kept for the robot's links to follow, at least and at most: less than
/// the 10 s that TF remembers.
constexpr std::chrono::duration<double> kLeastHold(1.0), kMostHold(8.0);

}  // namespace

FollowRun::FollowRun(const FollowOptions& options, Streams& streams, RobotPlaces* robot)
    : frames_(options.frames),
      period_(1.0 / options.frame_rate),
      shows_motion_(options.shows_motion),
      streams_(streams),
      robot_(robot),
      hold_(robot ? std::clamp(robot->patience(), kLeastHold, kMostHold) : kLeastHold) {
  if (options.publish_tf) optical_.emplace(frames_, options.right);
}

bool FollowRun::begin() {
  waits_for_ = streams_.waitsForSubscribers();
  return waits_for_.empty();
}

Motion FollowRun::motionOf(const FoundTransform& found) {
  if (!shows_motion_ || found.stamp.isZero()) return {};  // static
  // Over a moment that senders at 50 Hz know, or else slower ones.
  for (const double before_s : {0.02, 0.1, 0.5}) {
    if (found.stamp.toSec() <= before_s) break;  // before the clock began; and zero would be the latest
    try {
      const FoundTransform earlier =
          lookUp(tf_.buffer, frames_.map, frames_.camera, found.stamp - ros::Duration(before_s));
      return Motion::between(earlier.parent_from_child, found.parent_from_child, before_s);
    } catch (const tf2::TransformException&) {
    }
  }
  ROS_WARN_ONCE("Pictures of which TF does not know how %s moved before are sharp and straight",
                frames_.camera.c_str());
  return {};
}

std::optional<Shot> FollowRun::nextShot() {
  const ros::Time now = ros::Time::now();
  try {
    if (!held_ || Clock::now() - held_since_ > hold_) {
      held_ = lookUp(tf_.buffer, frames_.map, frames_.camera, ros::Time(0));
      held_since_ = Clock::now();
    }
  } catch (const tf2::TransformException& error) {
    held_.reset();
    const std::string wanted = "the TF frame " + frames_.camera;
    waits_for_ = {wanted + ": " + error.what(), wanted};
    return std::nullopt;
  }
  if (optical_) optical_->publishWhereMissing(tf_.buffer);
  const FoundTransform found = *held_;
  // Static transforms carry no time. All others: the image belongs to the very moment of its pose.
  const bool is_static = found.stamp.isZero();
  const ros::Time stamp = is_static ? now : found.stamp;
  if (stamp == latest_) {
    held_.reset();
    waits_for_ = "the TF frame " + frames_.camera + " to be sent again";
    return std::nullopt;
  }
  Shot shot{taken_, stamp, found.parent_from_child};
  shot.motion = motionOf(found);
  // By the stamp, so that a bag played again gives the same, whatever is left out.
  shot.chance = static_cast<std::int64_t>(stamp.toNSec() / 1000000U);
  if (robot_) {
    std::optional<render::BodyPlaces> places = robot_->byTf(tf_.buffer, found.stamp);
    if (!places) {
      waits_for_ = robot_->waitsFor();
      return std::nullopt;
    }
    shot.map_from_links = std::move(*places);
  }
  held_.reset();
  return shot;
}

void FollowRun::watchSkies(const ros::Time& stamp) {
  constexpr int kMany = 10;  // a message may be lost, or late
  constexpr double kJitter = 1.2;
  const double spacing_s = streams_.skySpacing(stamp);
  sparse_ = spacing_s > kJitter * period_.toSec() ? sparse_ + 1 : 0;
  if (sparse_ < kMany) return;
  ROS_WARN_ONCE(
      "frame_rate asks for a picture every %.3f s, but the sun comes every %.3f s, and a picture under a sun "
      "that moves waits for the next one: a higher publish_rate of sun_position gives more",
      period_.toSec(), spacing_s);
}

Step FollowRun::step() {
  waits_for_ = streams_.waitsForSky();
  if (!waits_for_.empty()) return Step::kWaits;
  const ros::Time now = ros::Time::now();
  // A clock that jumped back starts all anew: the sky of a moment ahead would be long in coming. TF's
  // listener forgets such moments only when the next one comes.
  if (now < seen_) {
    tf_.buffer.clear();
    next_ = now;
    held_.reset();
    shot_.reset();
  }
  seen_ = now;
  if (now < next_) {
    waits_for_ = time_wait_.until(next_, "the next picture", period_);
    return Step::kWaits;
  }

  if (!shot_) shot_ = nextShot();
  if (!shot_) return Step::kWaits;
  waits_for_ = streams_.waitsForSky(shot_->stamp);
  if (!waits_for_.empty()) {
    // The frame goes on, and so does the sky: a later moment of both will come.
    if (streams_.missedSky(shot_->stamp)) shot_.reset();
    return Step::kWaits;
  }
  const Shot shot = *shot_;
  shot_.reset();
  // Keeps the mean rate, but does not hurry after a long wait.
  next_ = next_ + period_ < now ? now + period_ : next_ + period_;
  latest_ = shot.stamp;
  map_from_links_ = shot.map_from_links;
  watchSkies(shot.stamp);
  streams_.take(shot);
  taken_ += 1;
  streams_.poseOutput().publishProgress(taken_);
  return Step::kTook;
}

}  // namespace sunlit::ros_interface
