/// Marks of a picture's pixels, and of those around them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "sunlit/light/surfaces.h"

namespace sunlit::light {

/// One byte a pixel, with a margin, so that each has neighbours all around.
class PixelMap {
 public:
  /// Of each pixel of a tile, by row and column.
  using OfTile = std::array<std::array<std::uint8_t, Surfaces::kTileSize>, Surfaces::kTileSize>;

  static constexpr int kMargin = 8;

  PixelMap(int width, int height)
      : stride_(static_cast<std::size_t>(width) + 2 * kMargin),
        values_(stride_ * (static_cast<std::size_t>(height) + Surfaces::kTileSize + 2 * kMargin), 0) {}

  std::uint8_t& at(int x, int y) { return values_[place(x, y)]; }
  /// Also up to kMargin pixels beyond the picture, where it is 0.
  std::uint8_t at(int x, int y) const { return values_[place(x, y)]; }
  /// That of (x, y), and of those right of it, up to kMargin pixels beyond the picture.
  const std::uint8_t* from(int x, int y) const { return &values_[place(x, y)]; }
  /// All bits of the 5 × 5 pixels about each.
  OfTile bitsAround(const Tile& tile) const;
  /// How many of each pixel and its eight neighbours are marked with 1, where marks are 0 and 1.
  OfTile countAround(const Tile& tile) const;

 private:
  std::size_t place(int x, int y) const {
    return static_cast<std::size_t>(y + kMargin) * stride_ + static_cast<std::size_t>(x + kMargin);
  }

  std::size_t stride_;
  std::vector<std::uint8_t> values_;  ///< a whole tile may be read at the edge of the picture, too
};

}  // namespace sunlit::light
