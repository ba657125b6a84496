/// The sRGB curve to 8 bit, exactly rounded, at the cost of one table look-up.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace sunlit::image {

inline std::uint32_t floatBits(float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}
inline float floatOf(std::uint32_t bits) {
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// The curve as the standard has it (IEC 61966-2-1), rounded to the nearest level; `linear` in [0, 1].
inline int exactLevel(float linear) {
  const double x = linear;
  const double display = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
  return static_cast<int>(std::floor(255.0 * display + 0.5));
}

/// Numbers are sorted by the leading bits of their float into cells so narrow that at most one rounding step
/// falls into each: 128 cells an octave, where a cell spans at most 0.66 levels (at 0.5: 255 · 1.055 / 2.4 ·
/// 0.5^−0.583 / 256). A cell holds the level at its start and the number from which on the level is one
/// higher.
class DisplayCurve {
 public:
  static const DisplayCurve& instance() {
    static const DisplayCurve curve;
    return curve;
  }

  /// Equal to exactLevel() of `linear` clipped to [0, 1]; NaN is black.
  std::uint8_t encode(float linear) const {
    const float x = linear > kDarkest ? (linear < 1.0F ? linear : 1.0F) : kDarkest;
    const Cell& cell = cells_[(floatBits(x) - kFirstBits) >> kShift];
    return static_cast<std::uint8_t>(cell.level + (x >= cell.next ? 1 : 0));
  }

 private:
  static constexpr int kShift = 16;
  static constexpr float kDarkest = 0x1p-13F;               // rounds to level 0
  static constexpr std::uint32_t kFirstBits = 0x39000000U;  // of kDarkest
  static constexpr std::size_t kCells = 13 * 128 + 1;

  struct Cell {
    float next;
    std::int32_t level;
  };

  DisplayCurve() {
    for (std::size_t i = 0; i < kCells; ++i) {
      const std::uint32_t first = kFirstBits + static_cast<std::uint32_t>(i << kShift);
      std::uint32_t low = first;  // has the cell's level
      std::uint32_t high = first + (1U << kShift);
      const int level = exactLevel(floatOf(low));
      // The first number of the next level, or the next cell's start, which no number of this cell reaches.
      while (high - low > 1) {
        const std::uint32_t middle = low + (high - low) / 2;
        (exactLevel(floatOf(middle)) == level ? low : high) = middle;
      }
      cells_[i] = {floatOf(high), level};
    }
  }

  std::array<Cell, kCells> cells_;
};

}  // namespace sunlit::image
