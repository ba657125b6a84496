#include "light/picture/sky/picture_air.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

namespace sunlit::light {

PictureAir::PictureAir(const Surfaces& surfaces, const LightTable& table, const sky::Daylight& day)
    : surfaces_(surfaces),
      table_(table),
      day_(day),
      fog_top_m_(day.fog().per_m > 0.0f ? day.fog().top_m : std::numeric_limits<float>::infinity()),
      columns_((surfaces.width + Surfaces::kTileSize - 1) / Surfaces::kTileSize),
      rows_((surfaces.height + Surfaces::kTileSize - 1) / Surfaces::kTileSize),
      nodes_(place(0, rows_ + 1)) {
  tbb::parallel_for(0, (columns_ + 1) * (rows_ + 1),
                    [&](int i) { find(i % (columns_ + 1), i / (columns_ + 1)); });
}

std::uint64_t PictureAir::needed(int column, int row) const {
  std::uint64_t all = 0;
  for (int y = std::max(row - 1, 0); y <= std::min(row, rows_ - 1); ++y) {
    for (int x = std::max(column - 1, 0); x <= std::min(column, columns_ - 1); ++x)
      all |= table_.tile(static_cast<std::size_t>(y * columns_ + x)).air_nodes;
  }
  return all;
}

void PictureAir::find(int column, int row) {
  const auto x = static_cast<float>(column * Surfaces::kTileSize) - 0.5f;
  const auto y = static_cast<float>(row * Surfaces::kTileSize) - 0.5f;
  const Eigen::Vector3f towards = surfaces_.towards(x, y);
  Six* const nodes = &nodes_[place(column, row)];
  const std::uint64_t all = needed(column, row);
  for (int k = 0; k < kAirNodes; ++k) {
    if ((all >> k & 1) == 0) continue;
    const sky::AirColumn air = day_.airOver(towards, airDistance_m(k));
    nodes[k] << air.transmittance, air.airlight;
  }
}

sky::AirColumn PictureAir::before(std::size_t number, std::size_t index) const {
  const auto size = static_cast<float>(Surfaces::kTileSize);
  const Tile& tile = surfaces_.tiles[number];
  const LightTable::Rows& rows = table_.tile(number);
  const LightTable::DiscTarget& target = rows.targets[index];
  const Surface& surface = tile.surfaces[index];
  if (std::max(0.0f, surface.position.z() - surfaces_.eye.z()) > fog_top_m_)
    return day_.airOver(-surface.to_eye, (surface.position - surfaces_.eye).norm());
  const LightTable::AirPlace& distance = rows.air[index];
  const float right = (static_cast<float>(target.x) + 0.5f - static_cast<float>(tile.x)) / size;
  const float down = (static_cast<float>(target.y) + 0.5f - static_cast<float>(tile.y)) / size;
  const int column = tile.x / Surfaces::kTileSize, row = tile.y / Surfaces::kTileSize;
  const Six* const top = &nodes_[place(column, row)] + distance.node;
  const Six* const bottom = &nodes_[place(column, row + 1)] + distance.node;
  const auto acrossTile = [&](int k) {
    const Six above = top[k] + right * (top[k + kAirNodes] - top[k]);
    const Six below = bottom[k] + right * (bottom[k + kAirNodes] - bottom[k]);
    return Six(above + down * (below - above));
  };
  const Six nearer = acrossTile(0);
  const Six air = nearer + distance.beyond * (acrossTile(1) - nearer);
  return {air.head<3>(), air.tail<3>()};
}

}  // namespace sunlit::light
