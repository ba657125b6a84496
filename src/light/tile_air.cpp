#include "light/tile_air.h"

#include <algorithm>
#include <cmath>

namespace sunlit::light {
namespace {

/// Node 0 is at no distance, where there is no air; beyond the last one, 4096 km, lies nothing.
constexpr int kNodes = 46;

float nodeDistance_m(int k) {
  if (k == 0) return 0.0f;
  const float octave = std::ldexp(1.0f, (k - 1) / 2);
  return k % 2 == 1 ? octave : octave * 1.41421356f;
}

/// The last node that is not beyond `distance_m`.
int nodeBefore(float distance_m) {
  if (distance_m < 1.0f) return 0;
  int exponent = 0;
  const float mantissa = std::frexp(distance_m, &exponent);  // 0.5 … 1
  return std::min(1 + 2 * (exponent - 1) + (mantissa >= 0.70710678f ? 1 : 0), kNodes - 2);
}

}  // namespace

TileAir::TileAir(const Surfaces& surfaces, const sky::Daylight& day, const Tile& tile)
    : surfaces_(surfaces), day_(day), tile_(tile), nodes_(kNodes), known_(kNodes, false) {
  for (std::size_t i = 0; i < 4; ++i) {
    const auto x = static_cast<float>(tile.x + (i % 2 == 1 ? Surfaces::kTileSize : 0)) - 0.5f;
    const auto y = static_cast<float>(tile.y + (i / 2 == 1 ? Surfaces::kTileSize : 0)) - 0.5f;
    towards_[i] = (surfaces.pixel_origin + x * surfaces.pixel_right + y * surfaces.pixel_down).normalized();
  }
}

const TileAir::Corners& TileAir::node(int k) {
  const auto i = static_cast<std::size_t>(k);
  if (!known_[i]) {
    known_[i] = true;
    for (std::size_t c = 0; c < 4; ++c) {
      const sky::AirColumn air = day_.airOver(towards_[c], nodeDistance_m(k));
      nodes_[i][c] << air.transmittance, air.airlight;
    }
  }
  return nodes_[i];
}

sky::AirColumn TileAir::before(const Surface& surface) {
  const auto width = static_cast<std::uint32_t>(surfaces_.width);
  const auto size = static_cast<float>(Surfaces::kTileSize);
  const float right = (static_cast<float>(surface.pixel % width) + 0.5f - static_cast<float>(tile_.x)) / size;
  const float down = (static_cast<float>(surface.pixel / width) + 0.5f - static_cast<float>(tile_.y)) / size;
  const float distance = (surfaces_.eye - surface.position).norm();
  const int k = nodeBefore(distance);
  const float near = nodeDistance_m(k);
  const float beyond = std::min((distance - near) / (nodeDistance_m(k + 1) - near), 1.0f);
  const auto acrossTile = [&](const Corners& corners) {
    const Six top = corners[0] + right * (corners[1] - corners[0]);
    const Six bottom = corners[2] + right * (corners[3] - corners[2]);
    return Six(top + down * (bottom - top));
  };
  const Six nearer = acrossTile(node(k));
  const Six air = nearer + beyond * (acrossTile(node(k + 1)) - nearer);
  return {air.head<3>(), air.tail<3>()};
}

}  // namespace sunlit::light
