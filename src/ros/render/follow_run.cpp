#include <tf2/exceptions.h>

#include "ros/render/messages.h"
#include "ros/render/run.h"

namespace sunlit::ros_interface {

FollowRun::FollowRun(const std::string& frame, double frame_rate, Streams& streams)
    : frame_(frame), period_(1.0 / frame_rate), streams_(streams), listener_(buffer_) {}

Step FollowRun::step() {
  waits_for_ = streams_.waitsForSun();
  if (!waits_for_.empty()) return Step::kWaits;
  const ros::Time now = ros::Time::now();
  // A clock that jumped back starts the rhythm anew.
  if (next_ > now + period_) next_ = now;
  if (now < next_) return Step::kWaits;

  geometry_msgs::TransformStamped map_from_frame;
  try {
    map_from_frame = buffer_.lookupTransform(kMapFrame, frame_, ros::Time(0));
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
  // Keeps the mean rate, but does not hurry after a long wait.
  next_ = next_ + period_ < now ? now + period_ : next_ + period_;
  latest_ = stamp;
  streams_.take({taken_, stamp, fromTransform(map_from_frame.transform)});
  taken_ += 1;
  streams_.poseOutput().publishProgress(taken_);
  return Step::kTook;
}

}  // namespace sunlit::ros_interface
