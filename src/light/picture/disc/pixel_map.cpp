#include "light/picture/disc/pixel_map.h"

#include <cstring>

namespace sunlit::light {
namespace {

constexpr std::size_t kSide = Surfaces::kTileSize;

/// The bytes of a row, eight to a word: what compilers make of bytes one by one takes twenty times as long.
using Row = std::array<std::uint64_t, kSide / 8>;
static_assert(sizeof(Row) == kSide);

/// Joins, by columns and then by rows, what lies up to `kReach` pixels away. `join` takes words, and carries
/// nothing from byte to byte.
template <std::size_t kReach, typename Join>
PixelMap::OfTile joined(const std::uint8_t* top_left, std::size_t stride, Join join) {
  constexpr std::size_t kAcross = 2 * kReach + 1;
  const auto add = [&](const Row& other, Row* row) {
    for (std::size_t i = 0; i < row->size(); ++i) (*row)[i] = join((*row)[i], other[i]);
  };
  std::array<Row, kSide + 2 * kReach> rows;
  for (std::size_t y = 0; y < rows.size(); ++y) {
    std::memcpy(&rows[y], top_left + y * stride, kSide);
    for (std::size_t k = 1; k < kAcross; ++k) {
      Row right;
      std::memcpy(&right, top_left + y * stride + k, kSide);
      add(right, &rows[y]);
    }
  }
  PixelMap::OfTile all;
  for (std::size_t y = 0; y < kSide; ++y) {
    Row sum = rows[y];
    for (std::size_t k = 1; k < kAcross; ++k) add(rows[y + k], &sum);
    std::memcpy(&all[y], &sum, kSide);
  }
  return all;
}

}  // namespace

PixelMap::OfTile PixelMap::bitsAround(const Tile& tile) const {
  return joined<2>(&values_[place(tile.x - 2, tile.y - 2)], stride_,
                   [](std::uint64_t a, std::uint64_t b) { return a | b; });
}

PixelMap::OfTile PixelMap::countAround(const Tile& tile) const {
  return joined<1>(&values_[place(tile.x - 1, tile.y - 1)], stride_,
                   [](std::uint64_t a, std::uint64_t b) { return a + b; });
}

}  // namespace sunlit::light
