#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "render/mipmaps.h"
#include "render/texture_pyramid.h"
#include "sunlit/image/srgb.h"
#include "sunlit/render/texture_sizes.h"

namespace sunlit {
namespace {

/// Five by three texels of many colours.
scene::Texture someTexture() {
  scene::Texture texture;
  texture.width = 5;
  texture.height = 3;
  for (int i = 0; i < 4 * 5 * 3; ++i) texture.rgba.own().push_back(static_cast<std::uint8_t>(i * 97 % 256));
  return texture;
}

/// Linear value of a texel of a texture that repeats.
double texel(const scene::Texture& texture, int x, int y, int channel) {
  const int column = (x % texture.width + texture.width) % texture.width;
  const int row = (y % texture.height + texture.height) % texture.height;
  const auto at = static_cast<std::size_t>(4 * (row * texture.width + column) + channel);
  return static_cast<double>(image::linearOfSrgb()[texture.rgba[at]]);
}

double between(const scene::Texture& texture, double u, double v, int channel) {
  const double x = u * texture.width - 0.5, y = v * texture.height - 0.5;
  const int left = static_cast<int>(std::floor(x)), above = static_cast<int>(std::floor(y));
  const auto along = [&](int row) {
    const double a = texel(texture, left, row, channel), b = texel(texture, left + 1, row, channel);
    return a + (x - left) * (b - a);
  };
  return along(above) + (y - above) * (along(above + 1) - along(above));
}

TEST(Textures, AreInterpolatedInLinearLightAndRepeat) {
  const scene::Texture texture = someTexture();
  const render::TexturePyramid pyramid(texture, render::kNoCutoff);
  for (int i = -60; i <= 60; ++i) {
    const double u = 0.0371 * i, v = 0.0593 * i;
    const Eigen::Array3f color =
        pyramid.color(Eigen::Array2f(static_cast<float>(u), static_cast<float>(v)), 0.0f);
    for (int c = 0; c < 3; ++c) {
      // Single precision of a coordinate up to 4 times 5 texels.
      EXPECT_NEAR(color[c], between(texture, u, v, c), 5e-6) << u << ' ' << v;
    }
  }
}

TEST(Textures, MadeSmallerBeforeLookTheSame) {
  scene::Scene made;
  made.textures = {someTexture(), someTexture()};
  made.materials.resize(4);
  const std::array<float, 3> cutoffs = {0.6f, 0.2f, 0.6f};
  for (std::size_t m = 0; m < 3; ++m) {
    made.materials[m].base_texture = m < 2 ? 0 : 1;
    made.materials[m].alpha_mode = scene::AlphaMode::kMask;
    made.materials[m].alpha_cutoff = cutoffs[m];
  }
  made.materials[3].base_texture = 1;
  scene::Scene before = made;
  render::addSmallerSizes(&before);
  EXPECT_EQ(before.textures[0].smaller.size(), 2u);  // 2 × 1 and 1 × 1
  const render::TexturePyramids own(made), kept(before);
  for (std::int32_t m = 0; m < 4; ++m) {
    const render::TexturePyramid &a = *own.of(m), &b = *kept.of(m);
    ASSERT_EQ(a.sizes(), b.sizes());
    for (const float level : {0.0f, 0.7f, 1.3f, 2.0f}) {
      const Eigen::Array2f at(0.3f, 0.6f);
      EXPECT_EQ(a.color(at, level).matrix(), b.color(at, level).matrix()) << m << ' ' << level;
    }
    const auto masks = a.masks(), same = b.masks();
    for (std::size_t i = 0; m < 3 && i < masks.size(); ++i)
      EXPECT_TRUE(
          std::equal(masks[i].alpha, masks[i].alpha + masks[i].width * masks[i].height, same[i].alpha));
  }
}

TEST(Textures, ThatBlendHaveTheColourOfWhatIsThere) {
  // Every other texel is not there, and black as most programs leave it.
  scene::Texture texture;
  texture.width = texture.height = 8;
  for (int i = 0; i < 64; ++i) {
    const std::uint8_t there = (i + i / 8) % 2 == 0 ? 255 : 0;
    texture.rgba.own().insert(texture.rgba.own().end(), {there, there, there, there});
  }
  const render::TexturePyramid blends(texture, render::kBlends), opaque(texture, render::kNoCutoff);
  for (const float level : {0.0f, 0.5f, 1.0f, 2.0f, 3.0f}) {
    for (const float u : {0.1f, 0.33f, 0.52f})
      EXPECT_GT(blends.color({u, 0.4f}, level).minCoeff(), 0.99f) << level << ' ' << u;
  }
  EXPECT_NEAR(opaque.color({0.3f, 0.4f}, 2.0f)[0], 0.5f, 0.01f);
}

TEST(Textures, AreMixedBetweenTwoSizes) {
  const scene::Texture texture = someTexture();
  const render::TexturePyramid pyramid(texture, render::kNoCutoff);
  const Eigen::Array2f at(0.3f, 0.8f);
  const Eigen::Array3f fine = pyramid.color(at, 0.0f), coarse = pyramid.color(at, 1.0f);
  ASSERT_GT((fine - coarse).abs().maxCoeff(), 0.01f);  // else nothing is shown
  // Each size alone within a quarter of a level of its own, both in between.
  EXPECT_TRUE((pyramid.color(at, 0.25f) == fine).all());
  EXPECT_TRUE((pyramid.color(at, 0.75f) == coarse).all());
  for (const float share : {0.01f, 0.4f, 0.99f}) {
    const Eigen::Array3f mixed = pyramid.color(at, 0.25f + 0.5f * share);
    EXPECT_LT((mixed - (fine + share * (coarse - fine))).abs().maxCoeff(), 1e-6f) << share;  // rounding
  }
  EXPECT_TRUE((pyramid.color(at, 40.0f) == pyramid.color(at, 41.0f)).all());  // beyond the smallest
}

}  // namespace
}  // namespace sunlit
