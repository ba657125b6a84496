#include "render/mipmaps.h"

#include <Eigen/StdVector>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "sunlit/image/srgb.h"

namespace sunlit::render {

namespace {

/// One level in linear light: r g b a a texel.
struct LinearLevel {
  Eigen::Array4f texel(std::size_t i) const { return texels[i]; }
  float alpha(std::size_t i) const { return texels[i][3]; }
  std::size_t size() const { return texels.size(); }

  int width, height;
  std::vector<Eigen::Array4f, Eigen::aligned_allocator<Eigen::Array4f>> texels;
};

/// From linear light to 8 bits: by the table of the decoder, so that both agree to the bit.
class SrgbEncoder {
 public:
  /// The nearest code of 0 … 1.
  std::uint8_t nearest(float linear) const {
    if (!(linear > 0.0f)) return 0;
    if (linear >= 1.0f) return 255;
    std::size_t above = first_codes_[static_cast<std::size_t>(linear * kSteps)];
    while (decoded_[above] < linear) ++above;
    return static_cast<std::uint8_t>(linear - decoded_[above - 1] < decoded_[above] - linear ? above - 1
                                                                                             : above);
  }

 private:
  static constexpr int kSteps = 4096;
  /// For each of these steps of linear light its first code that is not below: where to begin to look.
  static const std::array<std::uint8_t, kSteps>& firstCodes() {
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

  const float* const decoded_ = image::linearOfSrgb().data();
  const std::uint8_t* const first_codes_ = firstCodes().data();
};

/// Level 0, by the bytes of the texture: looking them up takes less than to write and read them as floats.
class Linearised {
 public:
  explicit Linearised(const scene::Texture& texture)
      : width(texture.width), height(texture.height), texels_(texture.rgba.data()) {}

  Eigen::Array4f texel(std::size_t i) const {
    const std::uint8_t* const t = texels_ + 4 * i;
    return {colors_[t[0]], colors_[t[1]], colors_[t[2]], alpha(i)};
  }
  float alpha(std::size_t i) const { return static_cast<float>(texels_[4 * i + 3]) / 255.0f; }
  std::size_t size() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }

  const int width, height;

 private:
  const std::uint8_t* const texels_;
  const float* const colors_ = image::linearOfSrgb().data();
};

/// Where texel `i` of a row of `smaller` texels begins in the row of `larger`, in texels of the latter.
std::pair<int, int> footprint(int i, int smaller, int larger) {
  const int begin = i * larger / smaller;
  return {begin, std::max(begin + 1, (i + 1) * larger / smaller)};
}

template <typename Level>
LinearLevel halved(const Level& larger, bool weigh_by_alpha) {
  LinearLevel level{std::max(1, larger.width / 2), std::max(1, larger.height / 2), {}};
  level.texels.reserve(static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height));
  for (int y = 0; y < level.height; ++y) {
    const auto rows = footprint(y, level.height, larger.height);
    for (int x = 0; x < level.width; ++x) {
      const auto columns = footprint(x, level.width, larger.width);
      Eigen::Array4f sum = Eigen::Array4f::Zero(), weights = Eigen::Array4f::Zero();
      for (int j = rows.first; j < rows.second; ++j) {
        for (int i = columns.first; i < columns.second; ++i) {
          const Eigen::Array4f texel =
              larger.texel(static_cast<std::size_t>(j) * static_cast<std::size_t>(larger.width) +
                           static_cast<std::size_t>(i));
          // A little weight for the invisible ones gives fully transparent regions a colour, too.
          const float w = weigh_by_alpha ? texel[3] + 1e-4f : 1.0f;
          const Eigen::Array4f weight(w, w, w, 1.0f);
          sum += weight * texel;
          weights += weight;
        }
      }
      level.texels.push_back(sum / weights);
    }
  }
  return level;
}

double shareAbove(const Linearised& level, float threshold) {
  std::size_t above = 0;
  for (std::size_t i = 0; i < level.size(); ++i) above += level.alpha(i) >= threshold ? 1 : 0;
  return static_cast<double>(above) / static_cast<double>(level.size());
}

/// The factor on alpha that brings the share of `level` above `cutoff` nearest to `share`: cutoff over the
/// alpha that just this share of texels reaches.
float alphaScale(const LinearLevel& level, float cutoff, double share) {
  std::vector<float> alphas;
  alphas.reserve(level.size());
  for (std::size_t i = 0; i < level.size(); ++i) alphas.push_back(level.alpha(i));
  const double wanted = share * static_cast<double>(alphas.size());
  const auto count = std::lround(wanted);
  if (count == 0) return 1.0f;
  const auto last = alphas.begin() + (count - 1);
  std::nth_element(alphas.begin(), last, alphas.end(), std::greater<>());
  const float reached = *last;
  // Texels of equal alpha come or go together.
  float next = std::numeric_limits<float>::infinity();  // the least above
  double without = 0.0, with = 0.0;
  for (const float alpha : alphas) {
    if (alpha > reached) {
      next = std::min(next, alpha);
      ++without;
    }
    if (alpha >= reached) ++with;
  }
  const bool leave_out = without > 0.0 && wanted - without < with - wanted;
  const float threshold = leave_out ? next : reached;
  return threshold > 0.0f ? std::clamp(cutoff / threshold, 0.25f, 4.0f) : 1.0f;
}

scene::TextureSize encoded(const LinearLevel& level, float alpha_scale) {
  scene::TextureSize mip{level.width, level.height, std::vector<std::uint8_t>(4 * level.size())};
  const SrgbEncoder encoder;
  std::uint8_t* code = mip.rgba.data();
  for (const Eigen::Array4f& texel : level.texels) {
    for (int c = 0; c < 3; ++c) *code++ = encoder.nearest(texel[c]);
    *code++ = static_cast<std::uint8_t>(std::lround(std::min(1.0f, texel[3] * alpha_scale) * 255.0f));
  }
  return mip;
}

}  // namespace

std::vector<scene::TextureSize> smallerLevels(const scene::Texture& texture, float cutoff) {
  std::vector<scene::TextureSize> levels;
  if (texture.width <= 1 && texture.height <= 1) return levels;
  const bool masked = cutoff >= 0.0f, weigh_by_alpha = masked || cutoff == kBlends;
  const Linearised whole(texture);
  const double share = masked ? shareAbove(whole, cutoff) : 0.0;
  LinearLevel level = halved(whole, weigh_by_alpha);
  const auto add = [&] {
    levels.push_back(encoded(level, masked ? alphaScale(level, cutoff, share) : 1.0f));
  };
  for (add(); level.width > 1 || level.height > 1; add()) level = halved(level, weigh_by_alpha);
  return levels;
}

}  // namespace sunlit::render
