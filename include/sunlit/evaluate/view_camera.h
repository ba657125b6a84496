/// The camera of a picture that is evaluated, with its lens.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "sunlit/evaluate/features/features.h"
#include "sunlit/image/lens.h"

namespace sunlit::evaluate {

/// The pinhole is what the picture would be of without distortion: where it is asked for alone, key points
/// must be those of straightOnes().
struct ViewCamera : image::PinholeCamera {
  ViewCamera() = default;
  ViewCamera(const image::PinholeCamera& pinhole) : image::PinholeCamera(pinhole) {}
  /// Throws as image::Lens.
  ViewCamera(const image::PinholeCamera& pinhole, const image::Distortion& distortion)
      : image::PinholeCamera(pinhole) {
    if (!distortion.none()) lens = std::make_shared<const image::Lens>(pinhole, distortion);
  }

  std::shared_ptr<const image::Lens> lens;  ///< null: none

  /// Of a point in the optical frame; none where the lens shows nothing of it. Without a lens, z > 0; a wide
  /// one looks beside and behind itself.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point) const {
    return lens ? lens->project(point) : image::PinholeCamera::project(point);
  }
  /// The point at depth 1 m; none where the lens shows nothing.
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& pixel) const {
    return lens ? lens->unproject(pixel) : image::PinholeCamera::unproject(pixel);
  }
  /// As a depth image has it: along z, before a wide lens the distance.
  double depthOf(const Eigen::Vector3d& point) const {
    return lens && lens->wide() ? point.norm() : point.z();
  }
};

/// From the axis, beyond which a pinhole's pixels are too large to tell where a wide lens looks: 1 of its own
/// is 4 there across and 9 outwards.
inline constexpr double kStraightWithin_deg = 70.0;

/// Features that lie within it, twice.
struct StraightFeatures {
  Features seen;      ///< with each key point where it is in the picture
  Features straight;  ///< with each where the pinhole alone would show it
};

/// Of what the lens shows; all, where there is none.
StraightFeatures straightOnes(const Features& features, const ViewCamera& camera);

}  // namespace sunlit::evaluate
