#include "light/picture/disc/share_windows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

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

}  // namespace

/// What chance does to a window's rays.
struct ShareWindows::Chance {
  float rays, mean, allowed;  ///< mean share, and variance of one ray, times the square of the deviations

  /// Whether a part of the window has more or fewer of the lit rays than it may have by chance.
  bool excludes(int lit, int pixels) const {
    const auto part = static_cast<float>(kRays * pixels);
    const float excess = static_cast<float>(lit) - mean * part;
    return excess * excess > allowed * part * (1.0f - part / rays) + kRaysSquared;
  }
};

ShareWindows::ShareWindows(const PixelMap& lit, const Tile& tile) {
  std::array<std::array<std::uint8_t, kSide>, kSide> values;
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
  if (differ_) sumUp(values);
}

void ShareWindows::sumUp(const std::array<std::array<std::uint8_t, kSide>, kSide>& lit) {
  for (Sums* sums : {&lit_, &squares_, &pixels_}) (*sums)[0].fill(0);
  for (std::size_t y = 0; y < kSide; ++y) {
    int rays = 0, squares = 0, pixels = 0;
    lit_[y + 1][0] = squares_[y + 1][0] = pixels_[y + 1][0] = 0;
    for (std::size_t x = 0; x < kSide; ++x) {
      const int part = lit[y][x] > 0 ? 1 : 0, value = lit[y][x] - part;
      rays += value;
      squares += value * value;
      pixels += part;
      lit_[y + 1][x + 1] = static_cast<std::int16_t>(lit_[y][x + 1] + rays);
      squares_[y + 1][x + 1] = static_cast<std::int16_t>(squares_[y][x + 1] + squares);
      pixels_[y + 1][x + 1] = static_cast<std::int16_t>(pixels_[y][x + 1] + pixels);
    }
  }
}

int ShareWindows::sumOf(const Sums& sums, const Window& window) {
  const auto left = static_cast<std::size_t>(window.x - window.across),
             right = static_cast<std::size_t>(window.x + window.across + 1);
  const auto& above = sums[static_cast<std::size_t>(window.y - window.down)];
  const auto& below = sums[static_cast<std::size_t>(window.y + window.down + 1)];
  return below[right] - below[left] - above[right] + above[left];
}

/// A line or a spot in the middle: light that changes evenly from one side to the other has none.
bool ShareWindows::hasLine(const Window& window, const Chance& chance) const {
  const auto excludes = [&](int across, int down) {
    const Window part = window.part(across, down);
    return chance.excludes(lit(part), part.pixels());
  };
  const bool smallest = window.across == 1;
  for (int across = window.across, down = window.down; across > 0;) {
    across /= 2;
    down /= 2;
    if (excludes(across, window.down)) return true;
    if (window.down == 0) continue;
    if (excludes(window.across, down)) return true;
    // One pixel alone says nothing among many: in deep shade every ray that gets through would stand out.
    if ((smallest || across > 0) && excludes(across, down)) return true;
  }
  return false;
}

/// Two corners that are opposite are together as bright as the other two, where light changes evenly.
bool ShareWindows::hasSlantingEdge(const Window& window, const Chance& chance) const {
  if (window.down < 2) return false;
  const int to_side = (window.across + 1) / 2, to_row = (window.down + 1) / 2;
  const auto corner = [&](int side, int row) {
    return Window{window.x + side * to_side, window.y + row * to_row,
                  window.across - to_side - (window.across > 2), window.down - to_row - (window.down > 2)};
  };
  const int pixels = 2 * corner(1, 1).pixels();
  return chance.excludes(lit(corner(-1, -1)) + lit(corner(1, 1)), pixels) ||
         chance.excludes(lit(corner(1, -1)) + lit(corner(-1, 1)), pixels);
}

bool ShareWindows::isEven(const Window& window) const {
  const int all = lit(window), pixels = window.pixels();
  if (all == 0 || all == kRays * pixels) return true;
  const auto count = static_cast<float>(pixels), rays = kRays * count;
  const float mean = static_cast<float>(all) / rays, variance = mean * (1.0f - mean);
  // Shadows as fine as pixels, of grass or of a mesh, look like chance from afar, but all rays of a pixel
  // meet them together: more pixels are all lit or all dark than by chance.
  const float squares = static_cast<float>(sumOf(squares_, window)) - kRays * mean * static_cast<float>(all);
  if (squares > rays * variance * (1.0f + std::sqrt(2.0f / count)) + kSquaresMore) return false;
  const float deviations = pixels < 25 ? kDeviationsOfFew : kDeviations;
  const Chance chance{rays, mean, variance * deviations * deviations};
  return !hasLine(window, chance) && !hasSlantingEdge(window, chance);
}

/// With its outermost pixels by half.
float ShareWindows::mean(const Window& window) const {
  const int across = window.across, down = window.down;
  int sum = lit(window) + lit(window.part(across - 1, down));
  int rays = kRays * 4 * across;
  if (down > 0) {
    sum += lit(window.part(across, down - 1)) + lit(window.part(across - 1, down - 1));
    rays *= 4 * down;
  }
  return static_cast<float>(sum) / static_cast<float>(rays);
}

float ShareWindows::share(int x, int y) const {
  if (!differ_) return of_all_;
  for (const Reach& reach : kReaches) {
    const Window window{x + kReach, y + kReach, reach.across, reach.down};
    if (sumOf(pixels_, window) == window.pixels() && isEven(window)) return mean(window);
  }
  return -1.0f;
}

}  // namespace sunlit::light
