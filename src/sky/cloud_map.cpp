#include "cloud_map.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sunlit::sky {
namespace {

/// A number of 0 … 1 for each place of a lattice: Wang's integer hash.
float hashed(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
  std::uint32_t h = seed * 0x9E3779B1U + x * 0x85EBCA77U + y * 0xC2B2AE3DU;
  h = (h ^ 61U) ^ (h >> 16U);
  h *= 9U;
  h ^= h >> 4U;
  h *= 0x27D4EB2DU;
  h ^= h >> 15U;
  return static_cast<float>(h >> 8U) * 0x1p-24F;
}

/// Values on a lattice of `cells` an axis, which repeats itself, smoothly in between.
float valueNoise(float x, float y, int cells, std::uint32_t seed) {
  const auto ix = static_cast<int>(x), iy = static_cast<int>(y);
  const float fx = x - static_cast<float>(ix), fy = y - static_cast<float>(iy);
  const auto smooth = [](float t) { return t * t * t * (t * (6.0F * t - 15.0F) + 10.0F); };
  const auto corner = [&](int right, int down) {
    return hashed(static_cast<std::uint32_t>((ix + right) % cells),
                  static_cast<std::uint32_t>((iy + down) % cells), seed);
  };
  const float u = smooth(fx), v = smooth(fy);
  const float above = corner(0, 0) + u * (corner(1, 0) - corner(0, 0));
  const float below = corner(0, 1) + u * (corner(1, 1) - corner(0, 1));
  return above + v * (below - above);
}

/// From 2 km, the distance between cumuli, down to 40 m.
float cloudNoise(int x, int y, std::uint32_t seed) {
  constexpr int kOctaves = 7;
  constexpr float kFainter = 0.56F;  // a little rougher than the −5/3 law of measured cloud water
  float sum = 0.0F, amplitude = 1.0F;
  int cells = 5;
  for (int octave = 0; octave < kOctaves; ++octave) {
    const float scale = static_cast<float>(cells) / CloudMap::kSide;
    sum += amplitude * valueNoise(static_cast<float>(x) * scale, static_cast<float>(y) * scale, cells,
                                  seed + 1000003U * static_cast<std::uint32_t>(octave + 1));
    amplitude *= kFainter;
    cells *= 2;
  }
  return sum;
}

/// Beyond it, a double has no digits behind the point.
constexpr double kAllWhole = 0x1p52;

/// Asked for at every pixel of the sky: std::floor and std::fmod are function calls, and slow ones.
double floorOf(double value) {
  if (!(std::abs(value) < kAllWhole)) return value;
  const auto truncated = static_cast<double>(static_cast<std::int64_t>(value));
  return truncated > value ? truncated - 1.0 : truncated;
}

/// Remainder of a whole number by last + 1, a power of two. Of one so large that neighbours are not told
/// apart, any will do.
int wrapped(double whole, int last) {
  if (!(std::abs(whole) < kAllWhole)) whole = std::fmod(whole, last + 1);
  return static_cast<int>(static_cast<std::int64_t>(whole) & last);
}

struct Ranked {
  float value;
  std::uint32_t cell;
  bool operator<(const Ranked& other) const {
    return value < other.value || (value == other.value && cell < other.cell);
  }
};

}  // namespace

CloudMap::CloudMap(double cover_oktas, double optical_depth, std::uint32_t seed)
    : covered_share_(cover_oktas / 8.0), thickest_(2.0 * optical_depth) {
  constexpr std::size_t kCells = static_cast<std::size_t>(kSide) * kSide;
  std::vector<Ranked> ranked(kCells);
  tbb::parallel_for(0, static_cast<int>(kSide), [&](int y) {
    for (int x = 0; x < kSide; ++x) {
      const auto cell = static_cast<std::uint32_t>(y * kSide + x);
      ranked[cell] = {cloudNoise(x, y, seed), cell};
    }
  });
  tbb::parallel_sort(ranked.begin(), ranked.end());
  const auto cloudy = static_cast<std::size_t>(std::lround(covered_share_ * static_cast<double>(kCells)));
  levels_[0].assign(kCells, 0.0F);
  for (std::size_t i = kCells - cloudy; i < kCells; ++i) {
    const double share = (static_cast<double>(i - (kCells - cloudy)) + 0.5) / static_cast<double>(cloudy);
    levels_[0][ranked[i].cell] = static_cast<float>(depthAt(share));
  }
  for (std::size_t level = 1; level < kLevels; ++level) {
    const std::vector<float>& finer = levels_[level - 1];
    const std::size_t side = static_cast<std::size_t>(kSide) >> level;
    levels_[level].resize(side * side);
    for (std::size_t y = 0; y < side; ++y) {
      for (std::size_t x = 0; x < side; ++x) {
        const float* corner = &finer[2 * y * 2 * side + 2 * x];
        levels_[level][y * side + x] =
            0.25F * (corner[0] + corner[1] + corner[2 * side] + corner[2 * side + 1]);
      }
    }
  }
}

double CloudMap::meanPassed(double cosine) const {
  // ∫₀¹ e^(−a s) ds
  const double a = thickest_ / std::max(cosine, 1e-6);
  const double through = -std::expm1(-a) / a;
  return 1.0 - covered_share_ * (1.0 - through);
}

float CloudMap::at(int level, const Eigen::Vector2d& place_m) const {
  const int last = (kSide >> level) - 1;  // all its bits are 1
  const double width_m = static_cast<double>(kCell_m) * (1 << level);
  const auto split = [&](double along_m, int* cell) {
    const double at = along_m / width_m - 0.5;
    const double whole = floorOf(at);
    *cell = wrapped(whole, last);
    return static_cast<float>(at - whole);
  };
  int x = 0, y = 0;
  const float u = split(place_m.x(), &x), v = split(place_m.y(), &y);
  const std::vector<float>& cells = levels_[static_cast<std::size_t>(level)];
  const auto cell = [&](int right, int down) {
    return cells[static_cast<std::size_t>(((y + down) & last) * (last + 1) + ((x + right) & last))];
  };
  const float above = cell(0, 0) + u * (cell(1, 0) - cell(0, 0));
  const float below = cell(0, 1) + u * (cell(1, 1) - cell(0, 1));
  return above + v * (below - above);
}

float CloudMap::opticalDepth(const Eigen::Vector2d& place_m, float width_m) const {
  const float level =
      std::clamp(std::log2(std::max(width_m / kCell_m, 1.0F)), 0.0F, static_cast<float>(kLevels - 1));
  const int finer = std::min(static_cast<int>(level), kLevels - 2);
  const float beyond = level - static_cast<float>(finer);
  if (beyond <= 0.0F) return at(finer, place_m);
  const float fine = at(finer, place_m);
  return fine + beyond * (at(finer + 1, place_m) - fine);
}

std::shared_ptr<const CloudMap> CloudMaps::of(const Weather& weather) {
  constexpr std::size_t kMost = 8;  // of 5 MB
  const double depth = opticalDepthOf(weather);
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const Kept& kept : kept_) {
    if (kept.cover_oktas == weather.cover_oktas && kept.optical_depth == depth && kept.seed == weather.seed)
      return kept.map;
  }
  if (kept_.size() == kMost) kept_.erase(kept_.begin());
  kept_.push_back({weather.cover_oktas, depth, weather.seed,
                   std::make_shared<const CloudMap>(weather.cover_oktas, depth,
                                                    static_cast<std::uint32_t>(weather.seed))});
  return kept_.back().map;
}

}  // namespace sunlit::sky
