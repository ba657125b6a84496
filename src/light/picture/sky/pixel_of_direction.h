/// Which pixel a direction in `map` falls on.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "sunlit/light/surfaces.h"

namespace sunlit::light {

class PixelOfDirection {
 public:
  /// Keeps a reference.
  explicit PixelOfDirection(const Surfaces& surfaces);

  struct Place {
    Eigen::Vector2d pixel;  ///< also beside the picture
    double solid_angle;  ///< of the pixel there, sr; of a lens beside the picture, of the nearest one in it
  };
  /// Of the unit vector `towards`; nothing behind the camera, or beyond what the lens shows.
  std::optional<Place> at(const Eigen::Vector3d& towards) const;

 private:
  std::optional<Place> onLens(const Eigen::Vector3d& towards) const;

  const Surfaces& surfaces_;
  Eigen::Matrix3d pixel_from_map_;
  double area_;  ///< of a pixel at depth 1, where its depth is 1 too
};

}  // namespace sunlit::light
