#include "light/picture/disc/pixel_map.h"

namespace sunlit::light {
namespace {

constexpr std::size_t kSide = Surfaces::kTileSize;

/// Joins, by columns and then by rows, what lies up to `kReach` pixels away. Whole rows at once, in a form
/// that compilers turn into vector code.
template <std::size_t kReach, typename Join>
PixelMap::OfTile joined(const std::uint8_t* top_left, std::size_t stride, Join join) {
  constexpr std::size_t kAcross = 2 * kReach + 1;
  std::array<std::array<std::uint8_t, kSide>, kSide + 2 * kReach> rows;
  for (std::size_t y = 0; y < rows.size(); ++y) {
    const std::uint8_t* const from = top_left + y * stride;
    for (std::size_t x = 0; x < kSide; ++x) rows[y][x] = from[x];
    for (std::size_t k = 1; k < kAcross; ++k)
      for (std::size_t x = 0; x < kSide; ++x) rows[y][x] = join(rows[y][x], from[x + k]);
  }
  PixelMap::OfTile all;
  for (std::size_t y = 0; y < kSide; ++y) {
    all[y] = rows[y];
    for (std::size_t k = 1; k < kAcross; ++k)
      for (std::size_t x = 0; x < kSide; ++x) all[y][x] = join(all[y][x], rows[y + k][x]);
  }
  return all;
}

}  // namespace

PixelMap::OfTile PixelMap::bitsAround(const Tile& tile) const {
  return joined<2>(&values_[place(tile.x - 2, tile.y - 2)], stride_,
                   [](unsigned a, unsigned b) { return static_cast<std::uint8_t>(a | b); });
}

PixelMap::OfTile PixelMap::countAround(const Tile& tile) const {
  return joined<1>(&values_[place(tile.x - 1, tile.y - 1)], stride_,
                   [](unsigned a, unsigned b) { return static_cast<std::uint8_t>(a + b); });
}

}  // namespace sunlit::light
