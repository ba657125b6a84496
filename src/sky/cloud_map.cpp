#include "cloud_map.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

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

struct Ranked {
  float value;
  std::uint32_t cell;
  bool operator<(const Ranked& other) const {
    return value < other.value || (value == other.value && cell < other.cell);
  }
};

/// Of each cell.
std::vector<float> depthsOf(double covered_share, double thickest, std::uint32_t seed) {
  constexpr std::size_t kCells = static_cast<std::size_t>(CloudMap::kSide) * CloudMap::kSide;
  std::vector<Ranked> ranked(kCells);
  tbb::parallel_for(0, static_cast<int>(CloudMap::kSide), [&](int y) {
    for (int x = 0; x < CloudMap::kSide; ++x) {
      const auto cell = static_cast<std::uint32_t>(y * CloudMap::kSide + x);
      ranked[cell] = {cloudNoise(x, y, seed), cell};
    }
  });
  tbb::parallel_sort(ranked.begin(), ranked.end());
  const auto cloudy = static_cast<std::size_t>(std::lround(covered_share * static_cast<double>(kCells)));
  std::vector<float> depths(kCells, 0.0F);
  for (std::size_t i = kCells - cloudy; i < kCells; ++i) {
    const double share = (static_cast<double>(i - (kCells - cloudy)) + 0.5) / static_cast<double>(cloudy);
    depths[ranked[i].cell] = static_cast<float>(thickest * share);
  }
  return depths;
}

}  // namespace

CloudMap::CloudMap(double cover_oktas, double optical_depth, std::uint32_t seed)
    : covered_share_(cover_oktas / 8.0),
      thickest_(2.0 * optical_depth),
      depths_(depthsOf(covered_share_, thickest_, seed)) {}

double CloudMap::meanPassed(double cosine) const {
  // ∫₀¹ e^(−a s) ds
  const double a = thickest_ / std::max(cosine, 1e-6);
  const double through = -std::expm1(-a) / a;
  return 1.0 - covered_share_ * (1.0 - through);
}

CellMeans CloudMap::passed(double cosine) const {
  const auto slant = static_cast<float>(1.0 / std::max(cosine, 1e-6));
  std::vector<float> cells(depths_.cells().size());
  tbb::parallel_for(0, kSide, [&](int y) {
    const std::size_t row = static_cast<std::size_t>(y) * kSide;
    for (std::size_t i = row; i < row + kSide; ++i) {
      const float depth = depths_.cells()[i];
      cells[i] = depth > 0.0F ? std::exp(-depth * slant) : 1.0F;
    }
  });
  return CellMeans(std::move(cells));
}

std::shared_ptr<const CloudMap> CloudMaps::of(const Weather& weather) {
  constexpr std::size_t kMost = 8;  // of 5 MB
  const double depth = opticalDepthOf(weather);
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto known = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) {
    return kept.cover_oktas == weather.cover_oktas && kept.optical_depth == depth &&
           kept.seed == weather.seed;
  });
  if (known != kept_.end()) {
    std::rotate(known, known + 1, kept_.end());
    return kept_.back().map;
  }
  if (kept_.size() == kMost) kept_.erase(kept_.begin());
  // By itself: a thread that waits for the loops within would else take up other work, and may come here.
  tbb::this_task_arena::isolate([&] {
    kept_.push_back({weather.cover_oktas, depth, weather.seed,
                     std::make_shared<const CloudMap>(weather.cover_oktas, depth,
                                                      static_cast<std::uint32_t>(weather.seed))});
  });
  return kept_.back().map;
}

}  // namespace sunlit::sky
