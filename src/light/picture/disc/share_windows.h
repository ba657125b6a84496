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
  float share(int x, int y) const {
    return differ_ ? shares_[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)] : of_all_;
  }

  static constexpr int kReach = 8;  ///< of windows
  static constexpr std::size_t kSide = Surfaces::kTileSize + 2 * kReach;
  using Rays = std::array<std::array<std::uint8_t, kSide>, kSide>;

 private:
  bool differ_;   ///< there is both light and shade, else
  float of_all_;  ///< is the share everywhere
  std::array<std::array<float, Surfaces::kTileSize>, Surfaces::kTileSize> shares_;
};

}  // namespace sunlit::light
