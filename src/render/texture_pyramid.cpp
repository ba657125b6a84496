#include "render/texture_pyramid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>

namespace sunlit::render {
namespace {

/// The four texels about a point, by their offsets, and how far it lies between them.
struct Neighbours {
  std::size_t top_left, top_right, bottom_left, bottom_right;
  float right, down;

  Neighbours(int width, int height, float u, float v) {
    // Repeats by whole turns; texel centres lie at half-integers.
    const float x = (u - static_cast<float>(floorOf(u))) * static_cast<float>(width) - 0.5f;
    const float y = (v - static_cast<float>(floorOf(v))) * static_cast<float>(height) - 0.5f;
    const int left = floorOf(x), above = floorOf(y);
    right = x - static_cast<float>(left);
    down = y - static_cast<float>(above);
    // Rounding may take a coordinate just below a whole number to the end of the row.
    const int x0 = left < 0 ? width - 1 : std::min(left, width - 1);
    const int y0 = above < 0 ? height - 1 : std::min(above, height - 1);
    const auto x1 = static_cast<std::size_t>(x0 + 1 == width ? 0 : x0 + 1);
    const auto y1 = static_cast<std::size_t>(y0 + 1 == height ? 0 : y0 + 1);
    const auto row = static_cast<std::size_t>(width);
    top_left = static_cast<std::size_t>(y0) * row + static_cast<std::size_t>(x0);
    top_right = static_cast<std::size_t>(y0) * row + x1;
    bottom_left = y1 * row + static_cast<std::size_t>(x0);
    bottom_right = y1 * row + x1;
  }
};

/// The cutoff of the first material that masks with each texture.
std::vector<float> cutoffs(const scene::Scene& scene) {
  std::vector<float> values(scene.textures.size(), kNoCutoff);
  for (const scene::Material& material : scene.materials) {
    if (material.alpha_mode != scene::AlphaMode::kMask ||
        material.base_texture == scene::Material::kNoTexture)
      continue;
    float& value = values[static_cast<std::size_t>(material.base_texture)];
    if (value == kNoCutoff) value = material.alpha_cutoff;
  }
  return values;
}

}  // namespace

TexturePyramid::TexturePyramid(const scene::Texture& texture, float alpha_cutoff)
    : size_(static_cast<float>(texture.width), static_cast<float>(texture.height)),
      cutoff_(alpha_cutoff * 255.0f) {
  levels_.push_back({texture.width, texture.height, texture.rgba, {}});
  for (MipLevel& level : smallerLevels(texture, alpha_cutoff))
    levels_.push_back({level.width, level.height, std::move(level.rgba), {}});
  if (alpha_cutoff == kNoCutoff) return;
  for (Level& level : levels_) {
    level.alpha.resize(level.rgba.size() / 4);
    for (std::size_t i = 0; i < level.alpha.size(); ++i) level.alpha[i] = level.rgba[4 * i + 3];
  }
}

Eigen::Array3f TexturePyramid::bilinear(const Level& level, const Eigen::Array2f& at) const {
  const Neighbours n(level.width, level.height, at.x(), at.y());
  const auto& linear = linearOfSrgb();
  const std::uint8_t *const a = &level.rgba[4 * n.top_left], *const b = &level.rgba[4 * n.top_right],
                            *const c = &level.rgba[4 * n.bottom_left],
                            *const d = &level.rgba[4 * n.bottom_right];
  Eigen::Array3f color;
  for (int i = 0; i < 3; ++i) {
    const float top = linear[a[i]] + n.right * (linear[b[i]] - linear[a[i]]);
    const float bottom = linear[c[i]] + n.right * (linear[d[i]] - linear[c[i]]);
    color[i] = top + n.down * (bottom - top);
  }
  return color;
}

Eigen::Array3f TexturePyramid::color(const Eigen::Array2f& at, float level) const {
  const float last = static_cast<float>(levels_.size() - 1);
  const float clamped = level > 0.0f ? std::min(level, last) : 0.0f;
  const auto lower = static_cast<std::size_t>(clamped);
  const float share = clamped - static_cast<float>(lower);
  const Eigen::Array3f fine = bilinear(levels_[lower], at);
  if (share == 0.0f) return fine;
  return fine + share * (bilinear(levels_[lower + 1], at) - fine);
}

std::size_t TexturePyramid::nearest(const Level& level, float u, float v) {
  const int x = static_cast<int>((u - static_cast<float>(floorOf(u))) * static_cast<float>(level.width));
  const int y = static_cast<int>((v - static_cast<float>(floorOf(v))) * static_cast<float>(level.height));
  // Rounding may take a coordinate just below a whole number to the end of the row.
  return static_cast<std::size_t>(std::min(y, level.height - 1)) * static_cast<std::size_t>(level.width) +
         static_cast<std::size_t>(std::min(x, level.width - 1));
}

bool TexturePyramid::solid(float u, float v, float texels_squared) const {
  // The binary exponent of a number is its logarithm rounded down, half of it that of its root.
  std::uint32_t bits;
  std::memcpy(&bits, &texels_squared, sizeof(bits));
  const int logarithm = (static_cast<int>(bits >> 23) - 127) >> 1;
  const Level& level =
      levels_[static_cast<std::size_t>(std::clamp(logarithm, 0, static_cast<int>(levels_.size()) - 1))];
  if (logarithm > 0) return static_cast<float>(level.alpha[nearest(level, u, v)]) >= cutoff_;
  const Neighbours n(level.width, level.height, u, v);
  const auto alpha = [&](std::size_t texel) { return static_cast<float>(level.alpha[texel]); };
  const float top = alpha(n.top_left) + n.right * (alpha(n.top_right) - alpha(n.top_left));
  const float bottom = alpha(n.bottom_left) + n.right * (alpha(n.bottom_right) - alpha(n.bottom_left));
  return top + n.down * (bottom - top) >= cutoff_;
}

std::vector<TexturePyramid> texturePyramids(const scene::Scene& scene) {
  const std::vector<float> cutoff = cutoffs(scene);
  std::vector<std::optional<TexturePyramid>> made(scene.textures.size());
  tbb::parallel_for(std::size_t{0}, made.size(),
                    [&](std::size_t i) { made[i].emplace(scene.textures[i], cutoff[i]); });
  std::vector<TexturePyramid> pyramids;
  pyramids.reserve(made.size());
  for (auto& pyramid : made) pyramids.push_back(std::move(*pyramid));
  return pyramids;
}

}  // namespace sunlit::render
