#include "sunlit/evaluate/localise/odometry.h"

#include <stdexcept>
#include <utility>

namespace sunlit::evaluate {

Odometry::Odometry(const DescriptorSpace& space, const LocaliserOptions& options)
    : space_(space), options_(options) {
  options_.retrieval = Retrieval::kAll;
  requireFields(options_);
}

Eigen::Isometry3d Odometry::follow(const PosedView& view, const Features& features) {
  requireWhole(view);
  if (view.depth.empty()) throw std::invalid_argument("a view has no depth, but odometry needs it");
  if (!key_frame_) {
    map_from_optical_ = view.map_from_optical;
    takeAsKeyFrame(view, features);
    return map_from_optical_;
  }
  const Features straight = straightOnes(features, view.camera).straight;
  const LocalisedQuery found = key_frame_->localise({straight, view.camera, map_from_optical_});
  const bool is_lost = found.status != LocalisationStatus::kLocalised;
  const Eigen::Isometry3d before = map_from_optical_;
  map_from_optical_ = is_lost ? before * before_from_last_ : found.estimate.map_from_optical;
  before_from_last_ = before.inverse() * map_from_optical_;
  const std::size_t shared = found.estimate.inliers.size();
  if (shared_at_first_ == 0) shared_at_first_ = shared;
  if (is_lost) ++lost_;
  if (is_lost || static_cast<double>(shared) < kSharedWithKeyFrame * static_cast<double>(shared_at_first_))
    takeAsKeyFrame(view, features);
  return map_from_optical_;
}

void Odometry::takeAsKeyFrame(const PosedView& view, const Features& features) {
  PosedView placed = view;
  placed.map_from_optical = map_from_optical_;
  key_frame_ = std::make_unique<Localiser>(space_, options_);
  key_frame_->add(keyFrameOf(placed, features));
  shared_at_first_ = 0;
  ++key_frames_;
}

}  // namespace sunlit::evaluate
