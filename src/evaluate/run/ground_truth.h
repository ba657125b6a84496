/// What is known of pictures beside their pixels, brought together by stamps.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <map>
#include <opencv2/core/mat.hpp>
#include <utility>
#include <vector>

#include "evaluate/run/stamp_sets.h"
#include "sunlit/evaluate/run/told.h"
#include "sunlit/evaluate/view_camera.h"

namespace sunlit::evaluate {

/// Poses and depth come once a stamp, whatever the stream; a camera belongs to its stream. Of what comes
/// twice the last counts.
class GroundTruth {
 public:
  using Pose = Told<Eigen::Isometry3d>;  ///< map_from_optical
  using Depth = Told<cv::Mat>;           ///< as in PosedView
  using Camera = Told<ViewCamera>;

  /// Of one stamp.
  struct View {
    Pose map_from_optical;
    Depth depth;
    std::vector<Camera> cameras;  ///< by stream, as they were when it was taken
  };

  explicit GroundTruth(std::size_t streams) : cameras_(streams) {}

  void addPose(std::int64_t stamp_ns, const Pose& map_from_optical) {
    views_[stamp_ns].map_from_optical = map_from_optical;
  }
  void addDepth(std::int64_t stamp_ns, const Depth& depth) {
    Depth& held = views_[stamp_ns].depth;
    bytes_ += bytesOf(depth.value) - bytesOf(held.value);
    held = depth;
  }
  void addCamera(std::size_t stream, const Camera& camera) { cameras_.at(stream) = camera; }

  const Camera& camera(std::size_t stream) const { return cameras_.at(stream); }
  /// Pose and depth have come, usable or not.
  bool has(std::int64_t stamp_ns) const {
    const auto found = views_.find(stamp_ns);
    return found != views_.end() && found->second.map_from_optical.has_come && found->second.depth.has_come;
  }
  /// What there is of a stamp, which is forgotten.
  View take(std::int64_t stamp_ns) {
    View view;
    if (const auto found = views_.find(stamp_ns); found != views_.end()) {
      view = std::move(found->second);
      bytes_ -= bytesOf(view.depth.value);
      views_.erase(found);
    }
    view.cameras = cameras_;
    return view;
  }
  /// Of depth that waits.
  std::size_t bytes() const { return bytes_; }
  /// Of what waits; there is something.
  std::int64_t oldest() const { return views_.begin()->first; }

 private:
  std::vector<Camera> cameras_;
  std::map<std::int64_t, View> views_;
  std::size_t bytes_ = 0;
};

}  // namespace sunlit::evaluate
