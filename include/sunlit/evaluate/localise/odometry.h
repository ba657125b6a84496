/// A small RGB-D odometry: where a camera went, from its own pictures and depth alone. A baseline for the
/// drift of others, by hour.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <memory>
#include <string>

#include "sunlit/evaluate/localise/localiser.h"
#include "sunlit/evaluate/posed_view.h"

namespace sunlit::evaluate {

/// A view becomes the next key frame where it shares fewer than this part of the inliers that the first view
/// behind the last key frame shared with that.
constexpr double kSharedWithKeyFrame = 0.5;

/// Each view's pose is found in the key frame before it: a map of one. One that is not found is taken to have
/// moved on as the view before it did, and becomes the next key frame.
class Odometry {
 public:
  /// `space` as a Localiser has it; of `options` the ratio test and how poses are found.
  /// Throws std::invalid_argument for options out of range.
  Odometry(const DescriptorSpace& space, const LocaliserOptions& options);

  /// The next view, whose pose is not used but for the first, where the estimate begins; it has depth. Its
  /// estimated map_from_optical. Throws std::invalid_argument for a view without depth.
  Eigen::Isometry3d follow(const PosedView& view, const Features& features);

  std::size_t keyFrames() const { return key_frames_; }
  std::size_t lost() const { return lost_; }  ///< views that were not found

 private:
  void takeAsKeyFrame(const PosedView& view, const Features& features);

  DescriptorSpace space_;
  LocaliserOptions options_;
  std::unique_ptr<Localiser> key_frame_;
  Eigen::Isometry3d map_from_optical_ = Eigen::Isometry3d::Identity();  ///< of the last view
  Eigen::Isometry3d before_from_last_ = Eigen::Isometry3d::Identity();  ///< how it moved
  std::size_t shared_at_first_ = 0;
  std::size_t key_frames_ = 0;
  std::size_t lost_ = 0;
};

}  // namespace sunlit::evaluate
