#include "light/picture/sky/pixel_of_direction.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace sunlit::light {

PixelOfDirection::PixelOfDirection(const Surfaces& surfaces) : surfaces_(surfaces) {
  Eigen::Matrix3d map_from_pixel;
  map_from_pixel << surfaces.pixel_right.cast<double>(), surfaces.pixel_down.cast<double>(),
      surfaces.pixel_origin.cast<double>();
  pixel_from_map_ = map_from_pixel.inverse();
  area_ = std::abs(map_from_pixel.determinant());
}

std::optional<PixelOfDirection::Place> PixelOfDirection::at(const Eigen::Vector3d& towards) const {
  if (surfaces_.bent) return onLens(towards);
  const Eigen::Vector3d homogeneous = pixel_from_map_ * towards;
  if (homogeneous.z() <= 0.0) return std::nullopt;
  // A ray of depth 1 is 1 / homogeneous.z() long; solid angle goes with the cube of that.
  return Place{homogeneous.head<2>() / homogeneous.z(), area_ * std::pow(homogeneous.z(), 3)};
}

std::optional<PixelOfDirection::Place> PixelOfDirection::onLens(const Eigen::Vector3d& towards) const {
  const PixelRays& rays = *surfaces_.bent;
  const auto pixel = rays.lens().project(surfaces_.map_from_optical.transpose() * towards);
  if (!pixel) return std::nullopt;
  const double x = std::clamp(pixel->x(), 0.0, surfaces_.width - 1.0);
  const double y = std::clamp(pixel->y(), 0.0, surfaces_.height - 1.0);
  Eigen::Matrix3d sides;
  sides << rays.right(x, y), rays.down(x, y), rays.at(x, y);
  return Place{*pixel, std::abs(sides.determinant()) / std::pow(sides.col(2).norm(), 3)};
}

}  // namespace sunlit::light
