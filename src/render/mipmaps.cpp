#include "render/mipmaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

#include "sunlit/image/srgb.h"

namespace sunlit::render {

namespace {

/// One level in linear light: r g b a a texel.
struct LinearLevel {
  int width, height;
  std::vector<float> rgba;
};

/// Where to begin to look in the table of the decoder: for each of these steps of linear light, its first
/// code that is not below.
constexpr int kSteps = 4096;
const std::array<std::uint8_t, kSteps>& firstCodes() {
  static const std::array<std::uint8_t, kSteps> codes = [] {
    const auto& table = image::linearOfSrgb();
    std::array<std::uint8_t, kSteps> first{};
    for (int i = 0; i < kSteps; ++i) {
      const float linear = static_cast<float>(i) / kSteps;
      first[static_cast<std::size_t>(i)] =
          static_cast<std::uint8_t>(std::lower_bound(table.begin(), table.end(), linear) - table.begin());
    }
    return first;
  }();
  return codes;
}

/// The nearest 8-bit code of 0 … 1: found in the table of the decoder, so that both agree to the bit.
std::uint8_t srgbOfLinear(float linear) {
  if (!(linear > 0.0f)) return 0;
  if (linear >= 1.0f) return 255;
  const auto& table = image::linearOfSrgb();
  std::size_t above = firstCodes()[static_cast<std::size_t>(linear * kSteps)];
  while (table[above] < linear) ++above;
  return static_cast<std::uint8_t>(linear - table[above - 1] < table[above] - linear ? above - 1 : above);
}

LinearLevel linearised(const scene::Texture& texture) {
  LinearLevel level{texture.width, texture.height, std::vector<float>(texture.rgba.size())};
  for (std::size_t i = 0; i < texture.rgba.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c) level.rgba[i + c] = image::linearOfSrgb()[texture.rgba[i + c]];
    level.rgba[i + 3] = static_cast<float>(texture.rgba[i + 3]) / 255.0f;
  }
  return level;
}

/// Where texel `i` of a row of `smaller` texels begins in the row of `larger`, in texels of the latter.
std::pair<int, int> footprint(int i, int smaller, int larger) {
  const int begin = i * larger / smaller;
  return {begin, std::max(begin + 1, (i + 1) * larger / smaller)};
}

LinearLevel halved(const LinearLevel& larger, bool weigh_by_alpha) {
  LinearLevel level{std::max(1, larger.width / 2), std::max(1, larger.height / 2), {}};
  level.rgba.resize(static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height) * 4);
  for (int y = 0; y < level.height; ++y) {
    const auto rows = footprint(y, level.height, larger.height);
    for (int x = 0; x < level.width; ++x) {
      const auto columns = footprint(x, level.width, larger.width);
      Eigen::Array3f color = Eigen::Array3f::Zero();
      float alpha = 0.0f, weight = 0.0f;
      int count = 0;
      for (int j = rows.first; j < rows.second; ++j) {
        for (int i = columns.first; i < columns.second; ++i, ++count) {
          const float* texel =
              &larger.rgba[4 * (static_cast<std::size_t>(j) * static_cast<std::size_t>(larger.width) +
                                static_cast<std::size_t>(i))];
          // A little weight for the invisible ones gives fully transparent regions a colour, too.
          const float w = weigh_by_alpha ? texel[3] + 1e-4f : 1.0f;
          color += w * Eigen::Array3f(texel[0], texel[1], texel[2]);
          alpha += texel[3];
          weight += w;
        }
      }
      float* texel = &level.rgba[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(level.width) +
                                      static_cast<std::size_t>(x))];
      for (int c = 0; c < 3; ++c) texel[c] = color[c] / weight;
      texel[3] = alpha / static_cast<float>(count);
    }
  }
  return level;
}

double shareAbove(const LinearLevel& level, float threshold) {
  std::size_t above = 0;
  for (std::size_t i = 3; i < level.rgba.size(); i += 4) above += level.rgba[i] >= threshold ? 1 : 0;
  return 4.0 * static_cast<double>(above) / static_cast<double>(level.rgba.size());
}

/// The factor on alpha that brings the share of `level` above `cutoff` nearest to `share`: cutoff over the
/// alpha that just this share of texels reaches.
float alphaScale(const LinearLevel& level, float cutoff, double share) {
  std::vector<float> alphas;
  for (std::size_t i = 3; i < level.rgba.size(); i += 4) alphas.push_back(level.rgba[i]);
  std::sort(alphas.begin(), alphas.end(), std::greater<>());
  const double wanted = share * static_cast<double>(alphas.size());
  if (std::lround(wanted) == 0) return 1.0f;
  const float reached = alphas[static_cast<std::size_t>(std::lround(wanted)) - 1];
  // Texels of equal alpha come or go together.
  const auto equal = std::equal_range(alphas.begin(), alphas.end(), reached, std::greater<>());
  const auto with = static_cast<double>(equal.second - alphas.begin());
  const auto without = static_cast<double>(equal.first - alphas.begin());
  const bool leave_out = without > 0.0 && wanted - without < with - wanted;
  const float threshold = leave_out ? *(equal.first - 1) : reached;
  return threshold > 0.0f ? std::clamp(cutoff / threshold, 0.25f, 4.0f) : 1.0f;
}

MipLevel encoded(const LinearLevel& level, float alpha_scale) {
  MipLevel mip{level.width, level.height, std::vector<std::uint8_t>(level.rgba.size())};
  for (std::size_t i = 0; i < level.rgba.size(); i += 4) {
    for (std::size_t c = 0; c < 3; ++c) mip.rgba[i + c] = srgbOfLinear(level.rgba[i + c]);
    mip.rgba[i + 3] =
        static_cast<std::uint8_t>(std::lround(std::min(1.0f, level.rgba[i + 3] * alpha_scale) * 255.0f));
  }
  return mip;
}

}  // namespace

std::vector<MipLevel> smallerLevels(const scene::Texture& texture, float cutoff) {
  std::vector<MipLevel> levels;
  const bool masked = cutoff >= 0.0f;
  LinearLevel level = linearised(texture);
  const double share = masked ? shareAbove(level, cutoff) : 0.0;
  while (level.width > 1 || level.height > 1) {
    level = halved(level, masked);
    levels.push_back(encoded(level, masked ? alphaScale(level, cutoff, share) : 1.0f));
  }
  return levels;
}

}  // namespace sunlit::render
