/// What is known of pictures beside their pixels, brought together by stamps.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "evaluate/run/recent.h"
#include "evaluate/run/stamp_sets.h"
#include "evaluate/run/stream_cameras.h"
#include "sunlit/evaluate/run/told.h"

namespace sunlit::evaluate {

/// Poses and depth come once a stamp, whatever the stream; a camera belongs to its stream, too. Of what comes
/// twice the last counts. Poses without depth are remembered as Recent does.
class GroundTruth {
 public:
  using Pose = Told<Eigen::Isometry3d>;  ///< map_from_optical
  using Depth = Told<cv::Mat>;           ///< as in PosedView
  using Camera = StreamCameras::Camera;

  /// Of one stamp.
  struct View {
    Pose map_from_optical;
    Depth depth;
    std::vector<Camera> cameras;  ///< by stream
  };

  explicit GroundTruth(std::size_t streams) : cameras_(streams) {}

  void addPose(std::int64_t stamp_ns, const Pose& map_from_optical) {
    if (const auto found = views_.find(stamp_ns); found != views_.end()) {
      found->second.map_from_optical = map_from_optical;
    } else if (Pose* alone = poses_alone_.find(stamp_ns)) {
      *alone = map_from_optical;
    } else {
      poses_alone_.add(stamp_ns, map_from_optical);
    }
  }
  void addDepth(std::int64_t stamp_ns, const Depth& depth) {
    View& view = views_[stamp_ns];
    if (std::optional<Pose> alone = poses_alone_.take(stamp_ns)) view.map_from_optical = std::move(*alone);
    depth_bytes_ += bytesOf(depth.value) - bytesOf(view.depth.value);
    view.depth = depth;
  }
  StreamCameras& cameras(std::size_t stream) { return cameras_.at(stream); }
  /// Pose and depth have come, usable or not.
  bool has(std::int64_t stamp_ns) const {
    const auto found = views_.find(stamp_ns);
    return found != views_.end() && found->second.map_from_optical.has_come;
  }
  /// What there is of a stamp, which is forgotten.
  View take(std::int64_t stamp_ns) {
    View view;
    if (std::optional<Pose> alone = poses_alone_.take(stamp_ns)) view.map_from_optical = std::move(*alone);
    if (const auto found = views_.find(stamp_ns); found != views_.end()) {
      view = std::move(found->second);
      depth_bytes_ -= bytesOf(view.depth.value);
      views_.erase(found);
    }
    for (StreamCameras& cameras : cameras_) view.cameras.push_back(cameras.take(stamp_ns));
    return view;
  }
  /// Poses without depth.
  void forgetPosesBefore(std::int64_t stamp_ns) {
    while (poses_alone_.size() > 0 && poses_alone_.leastKey() < stamp_ns)
      poses_alone_.take(poses_alone_.leastKey());
  }
  /// Of what waits.
  std::size_t bytes() const {
    return depth_bytes_ + views_.size() * sizeof(View) + poses_alone_.size() * sizeof(Pose);
  }
  /// The least stamp of what waits; there is something.
  std::int64_t oldest() const {
    if (views_.empty()) return poses_alone_.leastKey();
    const std::int64_t of_views = views_.begin()->first;
    return poses_alone_.size() == 0 ? of_views : std::min(of_views, poses_alone_.leastKey());
  }

 private:
  std::vector<StreamCameras> cameras_;
  std::map<std::int64_t, View> views_;  // with depth
  Recent<Pose> poses_alone_;
  std::size_t depth_bytes_ = 0;
};

}  // namespace sunlit::evaluate
