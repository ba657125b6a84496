#include "ros/evaluator/pose_frames.h"

#include <algorithm>

namespace sunlit::ros_interface {

std::string PoseFrames::note(const std::string& frame_id, const std::string& where) {
  const std::string frame = frame_id.substr(std::min(frame_id.find_first_not_of('/'), frame_id.size()));
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

}  // namespace sunlit::ros_interface
