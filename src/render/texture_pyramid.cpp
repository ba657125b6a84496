#include "render/texture_pyramid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "sunlit/image/srgb.h"
#include "sunlit/quantity/whole.h"
#include "sunlit/render/texture_sizes.h"
#include "sunlit/scene/wrap.h"

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
std::vector<float> firstCutoffs(const scene::Scene& scene) {
  std::vector<float> values(scene.textures.size(), kNoCutoff);
  for (const scene::Material& material : scene.materials) {
    if (!isMasked(material)) continue;
    float& value = values[static_cast<std::size_t>(material.base_texture)];
    if (value == kNoCutoff) value = material.alpha_cutoff;
  }
  return values;
}

/// Which sizes of which textures a scene's materials need.
struct Wanted {
  struct Pyramid {
    std::size_t texture;
    float cutoff;
    bool first;  ///< of its texture
  };
  std::vector<Pyramid> pyramids;
  std::vector<std::int32_t> of_material;  ///< index into pyramids, or kNoPyramid

  explicit Wanted(const scene::Scene& scene) {
    const std::vector<float> first_cutoffs = firstCutoffs(scene);
    for (const scene::Material& material : scene.materials) {
      of_material.push_back(kNoPyramid);
      if (material.base_texture == scene::Material::kNoTexture) continue;
      const auto texture = static_cast<std::size_t>(material.base_texture);
      const bool blends = material.alpha_mode == scene::AlphaMode::kBlend;
      of_material.back() = numberOf(texture, isMasked(material) ? material.alpha_cutoff
                                             : blends           ? kBlends
                                                                : first_cutoffs[texture]);
    }
  }

 private:
  std::int32_t numberOf(std::size_t texture, float cutoff) {
    bool first = true;
    for (std::size_t i = 0; i < pyramids.size(); ++i) {
      if (pyramids[i].texture != texture) continue;
      if (pyramids[i].cutoff == cutoff) return static_cast<std::int32_t>(i);
      first = false;
    }
    pyramids.push_back({texture, cutoff, first});
    return static_cast<std::int32_t>(pyramids.size() - 1);
  }
};

}  // namespace

TexturePyramid::Level::Level(int columns, int rows, const std::uint8_t* texels, bool masked)
    : width(columns), height(rows), rgba(texels) {
  if (!masked) return;
  alpha.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < alpha.size(); ++i) alpha[i] = rgba[4 * i + 3];
}

TexturePyramid::TexturePyramid(const scene::Texture& texture, float alpha_cutoff,
                               const std::vector<scene::TextureSize>& smaller)
    : size_(static_cast<float>(texture.width), static_cast<float>(texture.height)),
      cutoff_(alpha_cutoff * 255.0f),
      wrap_u_(texture.wrap_u),
      wrap_v_(texture.wrap_v),
      repeats_(wrap_u_ == scene::Wrap::kRepeat && wrap_v_ == scene::Wrap::kRepeat),
      blends_(alpha_cutoff == kBlends) {
  const bool masked = alpha_cutoff >= 0.0f;
  levels_.emplace_back(texture.width, texture.height, texture.rgba.data(), masked);
  for (const scene::TextureSize& size : smaller)
    levels_.emplace_back(size.width, size.height, size.rgba.data(), masked);
}

TexturePyramid::TexturePyramid(const scene::Texture& texture, float alpha_cutoff)
    : TexturePyramid(texture, alpha_cutoff, std::vector<scene::TextureSize>()) {
  smaller_ = smallerLevels(texture, alpha_cutoff);
  for (const scene::TextureSize& size : std::as_const(smaller_))
    levels_.emplace_back(size.width, size.height, size.rgba.data(), alpha_cutoff >= 0.0f);
}

namespace {

using Texel = Eigen::Array3f;

/// Of one size of a texture, as TexturePyramid keeps them.
struct Texels {
  const std::uint8_t* rgba;
  int width, height;
};

/// The four texels about a point, `u` and `v` of a whole turn, and how far it lies between them.
struct Corners {
  const std::uint8_t *a, *b, *c, *d;  ///< top left, top right, bottom left, bottom right
  float right, down;

  Corners(const Texels& texels, float u, float v) {
    const int width = texels.width, height = texels.height;
    // Texel centres lie at half-integers; half a texel less and one more keeps what is rounded positive.
    const float x = u * static_cast<float>(width) + 0.5f, y = v * static_cast<float>(height) + 0.5f;
    const int left = static_cast<int>(x), above = static_cast<int>(y);
    right = x - static_cast<float>(left);
    down = y - static_cast<float>(above);
    // Rounding may take a coordinate just below a whole number to the end of the row.
    const int x0 = left == 0 ? width - 1 : std::min(left, width) - 1;
    const int y0 = above == 0 ? height - 1 : std::min(above, height) - 1;
    const int x1 = x0 + 1 == width ? 0 : x0 + 1, y1 = y0 + 1 == height ? 0 : y0 + 1;
    const auto at = [&](int column, int row) {
      return texels.rgba + 4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(column));
    };
    a = at(x0, y0);
    b = at(x1, y0);
    c = at(x0, y1);
    d = at(x1, y1);
  }
};

Texel bilinear(const Texels& texels, float u, float v) {
  const Corners at(texels, u, v);
  const float* const linear = image::linearOfSrgb().data();
  Texel sum;
  for (int i = 0; i < 3; ++i) {
    const float first = linear[at.a[i]] + at.down * (linear[at.c[i]] - linear[at.a[i]]);
    const float second = linear[at.b[i]] + at.down * (linear[at.d[i]] - linear[at.b[i]]);
    sum[i] = first + at.right * (second - first);
  }
  return sum;
}

/// Colour times alpha, and alpha; a little of it where there is none, so that this has a colour, too.
Eigen::Array4f bilinearOfWhatIsThere(const Texels& texels, float u, float v) {
  constexpr float kLeast = 1e-3f;
  const Corners at(texels, u, v);
  const float* const linear = image::linearOfSrgb().data();
  const auto texel = [&](const std::uint8_t* t, float weight) -> Eigen::Array4f {
    const float there = weight * (static_cast<float>(t[3]) + kLeast);
    return {there * linear[t[0]], there * linear[t[1]], there * linear[t[2]], there};
  };
  return texel(at.a, (1.0f - at.right) * (1.0f - at.down)) + texel(at.b, at.right * (1.0f - at.down)) +
         texel(at.c, (1.0f - at.right) * at.down) + texel(at.d, at.right * at.down);
}

/// Of two sizes, the larger first, of which the smaller counts `share`.
template <typename Look, typename Level>
auto mixed(const Look& look, const Level* levels, float share) {
  auto sum = look(levels[share < 1.0f ? 0 : 1]);
  if (share > 0.0f && share < 1.0f) sum += share * (look(levels[1]) - sum);
  return sum;
}

}  // namespace

Eigen::Array3f TexturePyramid::color(const Eigen::Array2f& at, float level) const {
  // Repeats by whole turns.
  const float u = repeats_ ? at.x() - static_cast<float>(floorOf(at.x())) : scene::wrapped(at.x(), wrap_u_);
  const float v = repeats_ ? at.y() - static_cast<float>(floorOf(at.y())) : scene::wrapped(at.y(), wrap_v_);
  const float last = static_cast<float>(levels_.size() - 1);
  const float clamped = level > 0.0f ? std::min(level, last) : 0.0f;
  const auto lower = static_cast<std::size_t>(clamped);
  // Each size for itself near its own level, and between two in the half about their middle: a quarter of a
  // level does not show, and half of all look-ups need but one size.
  const float between = clamped - static_cast<float>(lower);
  const float share = std::clamp(2.0f * between - 0.5f, 0.0f, 1.0f);
  // Half a texel from an edge that does not repeat, its texels alone are seen.
  const auto inset = [](float coordinate, int size, scene::Wrap wrap) {
    const float half = 0.5f / static_cast<float>(size);
    return wrap == scene::Wrap::kRepeat ? coordinate : std::clamp(coordinate, half, 1.0f - half);
  };
  const Level* const levels = &levels_[lower];
  if (blends_) {
    const auto look = [&](const Level& l) {
      return bilinearOfWhatIsThere({l.rgba, l.width, l.height}, inset(u, l.width, wrap_u_),
                                   inset(v, l.height, wrap_v_));
    };
    const Eigen::Array4f sum = mixed(look, levels, share);
    return sum.head<3>() / sum[3];
  }
  const auto look = [&](const Level& l) {
    if (repeats_) return bilinear({l.rgba, l.width, l.height}, u, v);
    return bilinear({l.rgba, l.width, l.height}, inset(u, l.width, wrap_u_), inset(v, l.height, wrap_v_));
  };
  return mixed(look, levels, share);
}

TexturePyramid::Mask TexturePyramid::mask(float texels_squared) const {
  // The binary exponent of a number is its logarithm rounded down, half of it that of its root.
  std::uint32_t bits;
  std::memcpy(&bits, &texels_squared, sizeof(bits));
  const int logarithm = (static_cast<int>(bits >> 23) - 127) >> 1;
  const int number = std::clamp(logarithm, 0, static_cast<int>(levels_.size()) - 1);
  Mask mask = maskOf(levels_[static_cast<std::size_t>(number)]);
  mask.full = logarithm <= 0;
  return mask;
}

std::vector<TexturePyramid::Mask> TexturePyramid::masks() const {
  std::vector<Mask> masks;
  for (const Level& level : levels_) masks.push_back(maskOf(level));
  masks.front().full = true;
  return masks;
}

TexturePyramid::Mask TexturePyramid::maskOf(const Level& level) const {
  return {level.alpha.data(), level.width, level.height, false,
          static_cast<std::uint8_t>(std::ceil(cutoff_))};
}

bool TexturePyramid::solid(float u, float v) const {
  const Level& level = levels_.front();
  const Neighbours n(level.width, level.height, u, v);
  const auto alpha = [&](std::size_t texel) { return static_cast<float>(level.alpha[texel]); };
  const float top = alpha(n.top_left) + n.right * (alpha(n.top_right) - alpha(n.top_left));
  const float bottom = alpha(n.bottom_left) + n.right * (alpha(n.bottom_right) - alpha(n.bottom_left));
  return top + n.down * (bottom - top) >= cutoff_;
}

TexturePyramids::TexturePyramids(const scene::Scene& scene) {
  const Wanted wanted(scene);
  of_material_ = wanted.of_material;
  std::vector<std::optional<TexturePyramid>> made(wanted.pyramids.size());
  tbb::parallel_for(std::size_t{0}, made.size(), [&](std::size_t i) {
    const Wanted::Pyramid& one = wanted.pyramids[i];
    const scene::Texture& texture = scene.textures[one.texture];
    if (one.first && !texture.smaller.empty())
      made[i].emplace(texture, one.cutoff, texture.smaller);
    else
      made[i].emplace(texture, one.cutoff);
  });
  pyramids_.reserve(made.size());
  for (auto& pyramid : made) pyramids_.push_back(std::move(*pyramid));
}

void addSmallerSizes(scene::Scene* scene) {
  const Wanted wanted(*scene);
  tbb::parallel_for(std::size_t{0}, wanted.pyramids.size(), [&](std::size_t i) {
    const Wanted::Pyramid& one = wanted.pyramids[i];
    scene::Texture& texture = scene->textures[one.texture];
    if (one.first) texture.smaller = smallerLevels(texture, one.cutoff);
  });
}

}  // namespace sunlit::render
