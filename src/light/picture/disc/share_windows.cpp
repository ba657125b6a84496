#include "light/picture/disc/share_windows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "sunlit/quantity/vector_clones.h"

namespace sunlit::light {
namespace {

/// How far windows reach to the sides and up and down, those of more rays first. Ground that is seen at a low
/// angle changes faster up and down. Each spans whole periods of the pattern of points, once its outermost
/// pixels are taken by half: what all its rays aim at fills the disc evenly.
struct Reach {
  int across, down;
};
constexpr std::array<Reach, 8> kReaches = {{{8, 8}, {8, 2}, {4, 4}, {8, 0}, {4, 1}, {2, 2}, {4, 0}, {1, 1}}};

/// How many standard deviations chance is granted. Less leaves more grain, more blurs edges into the shade:
/// found by the error of ten views. The smallest window has too few rays to tell much.
constexpr float kDeviations = 2.2f, kDeviationsOfFew = 0.7f;
/// And so many rays, or squares of rays, as whole rays are not distributed normally where they are few.
constexpr float kRaysSquared = 1.0f, kSquaresMore = 1.0f;

constexpr int kRays = ShareWindows::kRays, kReach = ShareWindows::kReach;
constexpr std::size_t kSide = ShareWindows::kSide;

/// Sums over all pixels above and to the left.
using Sums = std::array<std::array<std::int16_t, kSide + 1>, kSide + 1>;
struct AllSums {
  Sums lit, squares, pixels;
};

void sumUp(const ShareWindows::Rays& lit, AllSums* all) {
  for (Sums* sums : {&all->lit, &all->squares, &all->pixels}) (*sums)[0].fill(0);
  for (std::size_t y = 0; y < kSide; ++y) {
    int rays = 0, squares = 0, pixels = 0;
    all->lit[y + 1][0] = all->squares[y + 1][0] = all->pixels[y + 1][0] = 0;
    for (std::size_t x = 0; x < kSide; ++x) {
      const int part = lit[y][x] > 0 ? 1 : 0, value = lit[y][x] - part;
      rays += value;
      squares += value * value;
      pixels += part;
      all->lit[y + 1][x + 1] = static_cast<std::int16_t>(all->lit[y][x + 1] + rays);
      all->squares[y + 1][x + 1] = static_cast<std::int16_t>(all->squares[y][x + 1] + squares);
      all->pixels[y + 1][x + 1] = static_cast<std::int16_t>(all->pixels[y][x + 1] + pixels);
    }
  }
}

// What follows is of all pixels of a row of the tile at once, side by side, so that it becomes vector code.
constexpr std::size_t kLanes = Surfaces::kTileSize;
using Counts = int[kLanes];
using Numbers = float[kLanes];
using Marks = int[kLanes];  ///< 0 or 1

/// About each pixel of a row (2 across + 1) × (2 down + 1) pixels, whose middle lies `right` and `below` of
/// it.
struct Window {
  int row, across, down;
  int right = 0, below = 0;

  int pixels() const { return (2 * across + 1) * (2 * down + 1); }
  Window part(int part_across, int part_down) const { return {row, part_across, part_down}; }
};

inline __attribute__((always_inline)) void addSums(const Sums& sums, const Window& window,
                                                   int* __restrict counts) {
  const auto left = static_cast<std::size_t>(kReach + window.right - window.across);
  const auto right = left + 2 * static_cast<std::size_t>(window.across) + 1;
  const int y = kReach + window.row + window.below;
  const std::int16_t* const above = sums[static_cast<std::size_t>(y - window.down)].data();
  const std::int16_t* const below = sums[static_cast<std::size_t>(y + window.down + 1)].data();
  for (std::size_t k = 0; k < kLanes; ++k)
    counts[k] += below[right + k] - below[left + k] - above[right + k] + above[left + k];
}

inline __attribute__((always_inline)) void sumsOf(const Sums& sums, const Window& window,
                                                  int* __restrict counts) {
  for (std::size_t k = 0; k < kLanes; ++k) counts[k] = 0;
  addSums(sums, window, counts);
}

/// What chance does to a window's rays.
struct Chance {
  float rays;
  Numbers mean, allowed;  ///< mean share, and variance of one ray, times the square of the deviations

  /// Marks where a part of the window has more or fewer of the lit rays than it may have by chance.
  inline __attribute__((always_inline)) void exclude(const int* counts, int pixels,
                                                     int* __restrict excluded) const {
    const auto part = static_cast<float>(kRays * pixels);
    const float rest = 1.0f - part / rays;
    for (std::size_t k = 0; k < kLanes; ++k) {
      const float excess = static_cast<float>(counts[k]) - mean[k] * part;
      excluded[k] |= excess * excess > allowed[k] * part * rest + kRaysSquared ? 1 : 0;
    }
  }
};

/// Marks a line or a spot in the middle: light that changes evenly from one side to the other has none.
inline __attribute__((always_inline)) void findLines(const Sums& lit, const Window& window,
                                                     const Chance& chance, int* __restrict uneven) {
  Counts counts;
  const bool smallest = window.across == 1;
  for (int across = window.across, down = window.down; across > 0;) {
    across /= 2;
    down /= 2;
    const auto look = [&](const Window& part) __attribute__((always_inline)) {
      sumsOf(lit, part, counts);
      chance.exclude(counts, part.pixels(), uneven);
    };
    look(window.part(across, window.down));
    if (window.down == 0) continue;
    look(window.part(window.across, down));
    // One pixel alone says nothing among many: in deep shade every ray that gets through would stand out.
    if (smallest || across > 0) look(window.part(across, down));
  }
}

/// Two corners that are opposite are together as bright as the other two, where light changes evenly.
inline __attribute__((always_inline)) void findSlantingEdges(const Sums& lit, const Window& window,
                                                             const Chance& chance, int* __restrict uneven) {
  if (window.down < 2) return;
  const int to_side = (window.across + 1) / 2, to_row = (window.down + 1) / 2;
  const int across = window.across - to_side - (window.across > 2 ? 1 : 0);
  const int down = window.down - to_row - (window.down > 2 ? 1 : 0);
  Counts counts;
  for (const int turn : {1, -1}) {
    const Window first{window.row, across, down, -to_side, -turn * to_row};
    const Window second{window.row, across, down, to_side, turn * to_row};
    sumsOf(lit, first, counts);
    addSums(lit, second, counts);
    chance.exclude(counts, 2 * first.pixels(), uneven);
  }
}

/// Marks windows within which chance and an even slope alone make pixels differ.
inline __attribute__((always_inline)) void findEven(const AllSums& sums, const Window& window,
                                                    int* __restrict even) {
  const int pixels = window.pixels();
  const auto count = static_cast<float>(pixels), rays = kRays * count;
  const float deviations = pixels < 25 ? kDeviationsOfFew : kDeviations;
  const float more = 1.0f + std::sqrt(2.0f / count);
  Counts all, squares;
  sumsOf(sums.lit, window, all);
  sumsOf(sums.squares, window, squares);
  Chance chance;
  chance.rays = rays;
  Marks uneven;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const float mean = static_cast<float>(all[k]) / rays, variance = mean * (1.0f - mean);
    // Shadows as fine as pixels, of grass or of a mesh, look like chance from afar, but all rays of a pixel
    // meet them together: more pixels are all lit or all dark than by chance.
    const float excess = static_cast<float>(squares[k]) - kRays * mean * static_cast<float>(all[k]);
    uneven[k] = excess > rays * variance * more + kSquaresMore ? 1 : 0;
    chance.mean[k] = mean;
    chance.allowed[k] = variance * deviations * deviations;
  }
  findLines(sums.lit, window, chance, uneven);
  findSlantingEdges(sums.lit, window, chance, uneven);
  const int most = kRays * pixels;
  for (std::size_t k = 0; k < kLanes; ++k)
    even[k] = (all[k] == 0) | (all[k] == most) | (uneven[k] == 0) ? 1 : 0;
}

/// With their outermost pixels by half.
inline __attribute__((always_inline)) void findMeans(const Sums& lit, const Window& window,
                                                     float* __restrict means) {
  const int across = window.across, down = window.down;
  Counts sum;
  sumsOf(lit, window, sum);
  addSums(lit, window.part(across - 1, down), sum);
  int rays = kRays * 4 * across;
  if (down > 0) {
    addSums(lit, window.part(across, down - 1), sum);
    addSums(lit, window.part(across - 1, down - 1), sum);
    rays *= 4 * down;
  }
  for (std::size_t k = 0; k < kLanes; ++k) means[k] = static_cast<float>(sum[k]) / static_cast<float>(rays);
}

inline __attribute__((always_inline)) bool any(const int* marks) {
  int found = 0;
  for (std::size_t k = 0; k < kLanes; ++k) found |= marks[k];
  return found != 0;
}

SUNLIT_WIDE_VECTOR_CLONES
void findShares(const AllSums& sums, int row, float* shares) {
  Marks open, whole, even;
  for (std::size_t k = 0; k < kLanes; ++k) {
    shares[k] = -1.0f;
    open[k] = 1;
  }
  for (const Reach& reach : kReaches) {
    const Window window{row, reach.across, reach.down};
    const int pixels = window.pixels();
    Counts counts;
    sumsOf(sums.pixels, window, counts);
    for (std::size_t k = 0; k < kLanes; ++k) whole[k] = open[k] & (counts[k] == pixels ? 1 : 0);
    if (!any(whole)) continue;
    findEven(sums, window, even);
    Numbers means;
    findMeans(sums.lit, window, means);
    for (std::size_t k = 0; k < kLanes; ++k) {
      const int found = whole[k] & even[k];
      shares[k] = found != 0 ? means[k] : shares[k];
      open[k] &= 1 - found;
    }
    if (!any(open)) return;
  }
}

}  // namespace

ShareWindows::ShareWindows(const PixelMap& lit, const Tile& tile) {
  Rays values;
  std::uint8_t brightest = 0, darkest = 255;  // by rays; at 255 none takes part
  for (std::size_t y = 0; y < kSide; ++y) {
    std::memcpy(&values[y], lit.from(tile.x - kReach, tile.y + static_cast<int>(y) - kReach), kSide);
    for (const std::uint8_t value : values[y]) {
      brightest = std::max(brightest, value);
      darkest = std::min(darkest, static_cast<std::uint8_t>(value - 1));
    }
  }
  const bool light = brightest > 1;
  differ_ = light && darkest < kRays;
  of_all_ = light ? 1.0f : 0.0f;
  if (!differ_) return;
  AllSums sums;
  sumUp(values, &sums);
  for (std::size_t y = 0; y < shares_.size(); ++y) findShares(sums, static_cast<int>(y), shares_[y].data());
}

}  // namespace sunlit::light
