#include <tf2/exceptions.h>

#include "ros/render/messages.h"
#include "ros/render/run.h"

namespace sunlit::ros_interface {

FollowRun::FollowRun(const std::string& frame, double frame_rate, Streams& streams, RobotPlaces* robot)
    : frame_(frame), period_(1.0 / frame_rate), streams_(streams), robot_(robot) {}

Step FollowRun::step() {
  waits_for_ = streams_.waitsForSky();
  if (!waits_for_.empty()) return Step::kWaits;
  const ros::Time now = ros::Time::now();
  // A clock that jumped back starts the rhythm anew.
  if (next_ > now + period_) next_ = now;
  if (now < next_) return Step::kWaits;

  geometry_msgs::TransformStamped map_from_frame;
  try {
    map_from_frame = tf_.buffer.lookupTransform(kMapFrame, frame_, ros::Time(0));
  } catch (const tf2::TransformException& error) {
    waits_for_ = "the TF frame " + frame_ + ": " + error.what();
    return Step::kWaits;
  }
  // Static transforms carry no time. All others: the image belongs to the very moment of its pose.
  const bool is_static = map_from_frame.header.stamp.isZero();
  const ros::Time stamp = is_static ? now : map_from_frame.header.stamp;
  if (stamp == latest_) {
    waits_for_ = "the TF frame " + frame_ + " to be sent again";
    return Step::kWaits;
  }
  if (robot_) {
    std::optional<render::BodyPlaces> places = robot_->byTf(tf_.buffer, map_from_frame.header.stamp);
    if (!places) {
      waits_for_ = robot_->waitsFor();
      return Step::kWaits;
    }
    map_from_links_ = std::move(*places);
  }
  // Keeps the mean rate, but does not hurry after a long wait.
  next_ = next_ + period_ < now ? now + period_ : next_ + period_;
  latest_ = stamp;
  streams_.take({taken_, stamp, fromTransform(map_from_frame.transform), map_from_links_});
  taken_ += 1;
  streams_.poseOutput().publishProgress(taken_);
  return Step::kTook;
}

}  // namespace sunlit::ros_interface
