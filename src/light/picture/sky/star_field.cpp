#include "light/picture/sky/star_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "light/picture/sky/pixel_of_direction.h"

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

}  // namespace

StarField::StarField(const Surfaces& surfaces, const sky::Daylight& day, const DiscInView& moon)
    : columns_((surfaces.width + Surfaces::kTileSize - 1) / Surfaces::kTileSize) {
  if (day.stars().empty()) return;
  const sky::Daylight seen = day.seenFrom(surfaces.eye);
  tiles_.resize(surfaces.tiles.size());
  const PixelOfDirection pixels(surfaces);
  for (const sky::PointLight& star : day.stars()) {
    const std::optional<PixelOfDirection::Place> place = pixels.at(star.towards.cast<double>());
    if (!place) continue;
    const Eigen::Vector2d& pixel = place->pixel;
    if (!(pixel.x() > -2.0 && pixel.x() < surfaces.width + 1.0 && pixel.y() > -2.0 &&
          pixel.y() < surfaces.height + 1.0))
      continue;
    const Eigen::Array3f luminance = seen.starSeen(star).value / static_cast<float>(place->solid_angle);
    if (LinearRgb(luminance).luminance() < kOutshone * seen.skyLuminance(star.towards).luminance()) continue;
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
