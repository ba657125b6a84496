/// Whether true poses are all of one frame, and those of a topic of one body.
#pragma once

#include <set>
#include <string>
#include <utility>

namespace sunlit::ros_interface {

/// Problems of poses in another frame are called so in files.
inline constexpr const char* kOtherFrame = "other_frame";

/// The frames in which true poses come. What is localised in a map of `map` but has its truth in `odom` is
/// measured from frame to frame. Some call one frame by two names, though, so that it is told, not refused.
class PoseFrames {
 public:
  /// A line that warns where this frame is another than the first, once for each place of each; else empty. A
  /// slash in front makes no difference, and a frame without a name says nothing. `where`: "/camera/pose of
  /// noon.bag".
  std::string note(const std::string& frame_id, const std::string& where);

 private:
  std::string first_, first_where_;
  std::set<std::pair<std::string, std::string>> told_;  // frames, and where they came
};

/// The body that the poses of one topic are of, by child_frame_id: those of two make no trajectory, though
/// bridges of motion capture send many on one topic.
class PoseBody {
 public:
  /// Where the messages come.
  struct Topic {
    std::string name, bag;
  };
  /// Throws std::runtime_error that names both bodies, and what keeps one, where this is another than the
  /// first. A slash in front makes no difference, and a body without a name says nothing.
  void require(const std::string& child_frame_id, const Topic& topic);
  /// Empty: none has said so.
  const std::string& name() const { return first_; }

 private:
  std::string first_;
};

}  // namespace sunlit::ros_interface
