#include "cell_means.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace sunlit::sky {
namespace {

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

}  // namespace

CellMeans::CellMeans(std::vector<float> cells) {
  levels_[0] = std::move(cells);
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

float CellMeans::at(int level, const Eigen::Vector2d& place_m) const {
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

float CellMeans::around(const Eigen::Vector2d& place_m, float width_m) const {
  const float level =
      std::clamp(std::log2(std::max(width_m / kCell_m, 1.0F)), 0.0F, static_cast<float>(kLevels - 1));
  const int finer = std::min(static_cast<int>(level), kLevels - 2);
  const float beyond = level - static_cast<float>(finer);
  if (beyond <= 0.0F) return at(finer, place_m);
  const float fine = at(finer, place_m);
  return fine + beyond * (at(finer + 1, place_m) - fine);
}

}  // namespace sunlit::sky
