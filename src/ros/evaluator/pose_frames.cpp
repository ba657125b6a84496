#include "ros/evaluator/pose_frames.h"

#include <stdexcept>

#include "sunlit/ros/frame_names.h"

namespace sunlit::ros_interface {

std::string PoseFrames::note(const std::string& frame_id, const std::string& where) {
  const std::string frame = withoutSlash(frame_id);
  if (frame.empty()) return "";
  if (first_.empty()) {
    first_ = frame;
    first_where_ = where;
  }
  if (frame == first_ || !told_.emplace(frame, where).second) return "";
  const std::string others = where == first_where_ ? "others" : "those of " + first_where_;
  return "poses of " + where + " are in the frame " + frame + ", " + others + " in " + first_ +
         ": errors mean nothing unless these are one frame";
}

void PoseBody::require(const std::string& child_frame_id, const Topic& topic) {
  const std::string body = withoutSlash(child_frame_id);
  if (first_.empty()) first_ = body;
  if (body.empty() || body == first_) return;
  throw std::runtime_error(topic.bag + ": " + topic.name + " has poses of " + first_ + " and of " + body +
                           " (child_frame_id), which make no trajectory; rosbag filter " + topic.bag +
                           " ONE.bag \"topic != '" + topic.name + "' or m.child_frame_id == '" + first_ +
                           "'\" keeps those of one");
}

}  // namespace sunlit::ros_interface
