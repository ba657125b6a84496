/// One sky, ready to be multiplied with many rows of coefficients.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "light/patches/sky_patches.h"

namespace sunlit::light {

/// The luminance of each patch in whole numbers: sums of products with bytes are exact, in any order.
class PatchSky {
 public:
  explicit PatchSky(const std::array<Eigen::Array3f, SkyPatches::kCount>& luminances) {
    for (int c = 0; c < 3; ++c) {
      float largest = 0.0f;
      for (const Eigen::Array3f& luminance : luminances) largest = std::max(largest, luminance[c]);
      const auto channel = static_cast<std::size_t>(c);
      scale_[channel] = largest / 32767.0f;
      for (std::size_t p = 0; p < SkyPatches::kCount; ++p) {
        patches_[channel][p] =
            largest > 0.0f ? static_cast<std::int16_t>(std::lround(luminances[p][c] / largest * 32767.0f))
                           : 0;
      }
    }
  }

  /// Luminances of one of red, green and blue, patch by patch, in parts of scale().
  const std::int16_t* channel(std::size_t rgb) const { return patches_[rgb].data(); }
  float scale(std::size_t rgb) const { return scale_[rgb]; }

  /// Of one patch, cd/m².
  Eigen::Array3f luminance(std::size_t patch) const {
    return {scale_[0] * patches_[0][patch], scale_[1] * patches_[1][patch], scale_[2] * patches_[2][patch]};
  }

  /// Sum of `row`, one byte a patch, times the patches' luminances, cd/m².
  Eigen::Array3f times(const std::uint8_t* row) const {
    std::int32_t r = 0, g = 0, b = 0;
    for (std::size_t p = 0; p < SkyPatches::kCount; ++p) {
      const auto coefficient = static_cast<std::int16_t>(row[p]);
      r += static_cast<std::int32_t>(coefficient) * patches_[0][p];
      g += static_cast<std::int32_t>(coefficient) * patches_[1][p];
      b += static_cast<std::int32_t>(coefficient) * patches_[2][p];
    }
    return {static_cast<float>(r) * scale_[0], static_cast<float>(g) * scale_[1],
            static_cast<float>(b) * scale_[2]};
  }

 private:
  /// 255 · 32767 · kCount stays below 2³¹.
  alignas(64) std::array<std::array<std::int16_t, SkyPatches::kCount>, 3> patches_;
  std::array<float, 3> scale_;
};

}  // namespace sunlit::light
