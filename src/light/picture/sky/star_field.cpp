#include "light/picture/sky/star_field.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace sunlit::light {
namespace {

constexpr float kOutshone = 1e-4f;  ///< of the sky's luminance: far below what 8 bits can show

/// Weights of the pixels −1, 0, 1, 2 from the one at or before the star, `t` pixels before it.
std::array<float, 4> splineWeights(double t) {
  const double s = 1.0 - t;
  return {
      static_cast<float>(s * s * s / 6.0), static_cast<float>((4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0),
      static_cast<float>((4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0), static_cast<float>(t * t * t / 6.0)};
}

/// Which pixel a direction in `map` falls on.
class PixelsOfStars {
 public:
  explicit PixelsOfStars(const Surfaces& surfaces) : surfaces_(surfaces) {
    Eigen::Matrix3d map_from_pixel;
    map_from_pixel << surfaces.pixel_right.cast<double>(), surfaces.pixel_down.cast<double>(),
        surfaces.pixel_origin.cast<double>();
    pixel_from_map_ = map_from_pixel.inverse();
    area_ = std::abs(map_from_pixel.determinant());
  }

  struct Place {
    Eigen::Vector2d pixel;
    double solid_angle;  ///< of the pixel there
  };
  std::optional<Place> at(const Eigen::Vector3d& towards) const {
    if (surfaces_.bent) return onLens(towards);
    const Eigen::Vector3d homogeneous = pixel_from_map_ * towards;
    if (homogeneous.z() <= 0.0) return std::nullopt;
    // A ray of depth 1 is 1 / homogeneous.z() long; solid angle goes with the cube of that.
    return Place{homogeneous.head<2>() / homogeneous.z(), area_ * std::pow(homogeneous.z(), 3)};
  }

 private:
  std::optional<Place> onLens(const Eigen::Vector3d& towards) const {
    const PixelRays& rays = *surfaces_.bent;
    const auto pixel = rays.lens().project(surfaces_.map_from_optical.transpose() * towards);
    if (!pixel) return std::nullopt;
    const double x = std::clamp(pixel->x(), 0.0, surfaces_.width - 1.0);
    const double y = std::clamp(pixel->y(), 0.0, surfaces_.height - 1.0);
    Eigen::Matrix3d sides;
    sides << rays.right(x, y), rays.down(x, y), rays.at(x, y);
    return Place{*pixel, std::abs(sides.determinant()) / std::pow(sides.col(2).norm(), 3)};
  }

  const Surfaces& surfaces_;
  Eigen::Matrix3d pixel_from_map_;
  double area_;  ///< of a pixel at depth 1, where its depth is 1 too
};

}  // namespace

StarField::StarField(const Surfaces& surfaces, const sky::Daylight& day, const DiscInView& moon)
    : columns_((surfaces.width + Surfaces::kTileSize - 1) / Surfaces::kTileSize) {
  if (day.stars().empty()) return;
  tiles_.resize(surfaces.tiles.size());
  const PixelsOfStars pixels(surfaces);
  for (const sky::PointLight& star : day.stars()) {
    const std::optional<PixelsOfStars::Place> place = pixels.at(star.towards.cast<double>());
    if (!place) continue;
    const Eigen::Vector2d& pixel = place->pixel;
    if (!(pixel.x() > -2.0 && pixel.x() < surfaces.width + 1.0 && pixel.y() > -2.0 &&
          pixel.y() < surfaces.height + 1.0))
      continue;
    const Eigen::Array3f luminance = star.illuminance.value / static_cast<float>(place->solid_angle);
    if (LinearRgb(luminance).luminance() < kOutshone * day.skyLuminance(star.towards).luminance()) continue;
    if (moon.hides(star.towards)) continue;
    add(surfaces, pixel, luminance);
  }
}

void StarField::add(const Surfaces& surfaces, const Eigen::Vector2d& pixel, const Eigen::Array3f& luminance) {
  const int left = static_cast<int>(std::floor(pixel.x()));
  const int above = static_cast<int>(std::floor(pixel.y()));
  const std::array<float, 4> across = splineWeights(pixel.x() - left);
  const std::array<float, 4> down = splineWeights(pixel.y() - above);
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      const int x = left - 1 + i;
      const int y = above - 1 + j;
      if (x < 0 || y < 0 || x >= surfaces.width || y >= surfaces.height) continue;
      tiles_[tileAt(x, y)].push_back(
          {x, y, luminance * (across[static_cast<std::size_t>(i)] * down[static_cast<std::size_t>(j)])});
    }
  }
}

std::size_t StarField::tileAt(int x, int y) const {
  const int tile = y / Surfaces::kTileSize * columns_ + x / Surfaces::kTileSize;
  return static_cast<std::size_t>(tile);
}

const std::vector<StarField::Spot>& StarField::in(const Tile& tile) const {
  if (tiles_.empty()) return none_;
  return tiles_[tileAt(tile.x, tile.y)];
}

}  // namespace sunlit::light
