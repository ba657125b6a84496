/// Which share of a disc pixels see, from few rays of each and those of their neighbours.
#pragma once

#include <array>
#include <cstdint>

#include "light/picture/disc/pixel_map.h"
#include "sunlit/light/surfaces.h"

namespace sunlit::light {

/// About each pixel the widest of several windows is sought within which nothing but chance and an even slope
/// makes pixels differ; its mean is the share in the middle. Chance is that of a binomial distribution, of
/// which rays to well spread points have less.
class ShareWindows {
 public:
  static constexpr int kRays = 4;  ///< of each pixel, to a quarter of the points of a block of 2 × 2 pixels

  /// Of one tile. `lit` holds 1 + how many of a pixel's rays got through, and 0 where a pixel takes no part.
  ShareWindows(const PixelMap& lit, const Tile& tile);

  /// Of the pixel in column x and row y of the tile; negative if its neighbours tell nothing about it.
  float share(int x, int y) const;

 private:
  static constexpr int kReach = 8;
  static constexpr std::size_t kSide = Surfaces::kTileSize + 2 * kReach;
  /// Sums over all pixels above and to the left.
  using Sums = std::array<std::array<std::int16_t, kSide + 1>, kSide + 1>;
  /// Of (2 across + 1) × (2 down + 1) pixels about (x, y).
  struct Window {
    int x, y, across, down;

    int pixels() const { return (2 * across + 1) * (2 * down + 1); }
    Window part(int part_across, int part_down) const { return {x, y, part_across, part_down}; }
  };
  struct Chance;

  static int sumOf(const Sums& sums, const Window& window);
  void sumUp(const std::array<std::array<std::uint8_t, kSide>, kSide>& lit);
  int lit(const Window& window) const { return sumOf(lit_, window); }
  bool isEven(const Window& window) const;
  bool hasLine(const Window& window, const Chance& chance) const;
  bool hasSlantingEdge(const Window& window, const Chance& chance) const;
  float mean(const Window& window) const;

  bool differ_;   ///< there is both light and shade, else
  float of_all_;  ///< is the share everywhere
  Sums lit_, squares_, pixels_;
};

}  // namespace sunlit::light
