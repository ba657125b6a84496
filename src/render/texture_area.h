/// How the area that a pixel covers of a texture is looked up.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "sunlit/quantity/whole.h"

namespace sunlit::render {

/// log2 of a positive number by its exponent and a straight line between powers of two, within 0.09: a tenth
/// of a level of a texture does not show.
inline float roughLog2(float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  return static_cast<float>(bits) * (1.0f / (1u << 23)) - 127.0f;
}

/// Several look-ups along the longer side of an area seen at a slant. Each reaches over two texels, so that
/// it covers its part of the area in a level whose texels are half as wide.
class TextureArea {
 public:
  /// How it is to be looked up.
  struct Filter {
    float lod_bias;  ///< levels
    bool small;      ///< in one size of the texture, not between two
  };
  /// Middle and sides, in texture coordinates.
  struct Spot {
    Eigen::Array2f at = Eigen::Array2f::Zero(), right = Eigen::Array2f::Zero(), down = Eigen::Array2f::Zero();
  };
  /// `size` of the texture, texels.
  TextureArea(const Spot& spot, const Eigen::Array2f& size, const Filter& filter) : at_(spot.at) {
    const Eigen::Array2f &right = spot.right, &down = spot.down;
    const float right_texels = (right * size).matrix().squaredNorm();
    const float down_texels = (down * size).matrix().squaredNorm();
    longer_ = right_texels > down_texels ? right : down;
    most_ = std::max(right_texels, down_texels);
    // Also where it is not a number.
    if (!(most_ < kMost)) most_ = kMost;
    const float least = std::max(std::min(right_texels, down_texels), 1e-12f);
    taps_ = most_ < 2.25f * least ? 1 : most_ < 9.0f * least ? 2 : 4;
    const float part = taps_ == 1 ? 1.0f : taps_ == 2 ? 2.0f : 3.0f;
    level_ = 0.5f * roughLog2(std::max(most_, 1e-12f)) - part + filter.lod_bias;
    if (filter.small) level_ = static_cast<float>(floorOf(level_ + 0.5f));
  }

  /// Whether one look-up in the full size will do.
  bool magnified() const { return level_ <= 0.0f && most_ < 1.0f; }
  const Eigen::Array2f& middle() const { return at_; }
  int taps() const { return taps_; }
  float level() const { return level_; }
  Eigen::Array2f tap(int i) const {
    const float place = (static_cast<float>(i) + 0.5f) / static_cast<float>(taps_) - 0.5f;
    return most_ < kMost ? Eigen::Array2f(at_ + place * longer_) : at_;
  }

 private:
  static constexpr float kMost = 1e12f;
  Eigen::Array2f at_, longer_;
  float most_, level_;
  int taps_;
};

}  // namespace sunlit::render
