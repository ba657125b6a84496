#include "light/cutout.h"

#include <algorithm>

#include "sunlit/quantity/whole.h"

namespace sunlit::light {
namespace {

constexpr int kNoMask = -1;

std::size_t blockWord(int x, int y, int blocks_a_row) {
  return static_cast<std::size_t>(((y >> 4) * blocks_a_row + (x >> 4)) * 16 + (y & 15));
}

}  // namespace

Cutouts::Mask::Mask(const scene::Texture& source, float alpha_cutoff)
    : texture(&source),
      width(source.width),
      height(source.height),
      cutoff(alpha_cutoff * 255.0f),
      alpha(source.rgba.size() / 4),
      blocks_a_row((source.width + 15) / 16) {
  for (std::size_t p = 0; p < alpha.size(); ++p) alpha[p] = source.rgba[4 * p + 3];
  squares.resize(static_cast<std::size_t>(blocks_a_row * ((height + 15) / 16)) * 16);
  const auto solid = [this](int x, int y) {
    return static_cast<float>(alpha[static_cast<std::size_t>(y % height) * static_cast<std::size_t>(width) +
                                    static_cast<std::size_t>(x % width)]) >= cutoff
               ? 1
               : 0;
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int corners = solid(x, y) + solid(x + 1, y) + solid(x, y + 1) + solid(x + 1, y + 1);
      const unsigned kind = corners == 0 ? kClear : corners == 4 ? kSolid : kMixed;
      squares[blockWord(x, y, blocks_a_row)] |= kind << (2 * (x & 15));
    }
  }
}

unsigned Cutouts::Mask::square(int x, int y) const {
  return squares[blockWord(x, y, blocks_a_row)] >> (2 * (x & 15)) & 3u;
}

float Cutouts::Mask::interpolated(int x0, int y0, float fx, float fy) const {
  const int x1 = x0 + 1 == width ? 0 : x0 + 1;
  const int y1 = y0 + 1 == height ? 0 : y0 + 1;
  const auto at = [this](int x, int y) {
    return static_cast<float>(
        alpha[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)]);
  };
  const float top = at(x0, y0) + fx * (at(x1, y0) - at(x0, y0));
  const float bottom = at(x0, y1) + fx * (at(x1, y1) - at(x0, y1));
  return top + fy * (bottom - top);
}

Cutouts::Cutouts(const Geometry& geometry) {
  const scene::Scene& scene = *geometry.scene;
  std::vector<std::int32_t> mask_of(scene.materials.size(), kNoMask);
  // Bodies share the materials of the whole scene and use few of them.
  std::vector<bool> used(scene.materials.size(), false);
  for (const std::int32_t material : geometry.materials) used[static_cast<std::size_t>(material)] = true;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const scene::Material& material = scene.materials[m];
    if (!used[m] || material.alpha_mode != scene::AlphaMode::kMask ||
        material.base_texture == scene::Material::kNoTexture)
      continue;
    const scene::Texture& texture = scene.textures[static_cast<std::size_t>(material.base_texture)];
    const auto same = std::find_if(masks_.begin(), masks_.end(), [&](const Mask& mask) {
      return mask.texture == &texture && mask.cutoff == material.alpha_cutoff * 255.0f;
    });
    mask_of[m] = static_cast<std::int32_t>(same - masks_.begin());
    if (same == masks_.end()) masks_.emplace_back(texture, material.alpha_cutoff);
  }
  for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
    Triangle triangle;
    triangle.mask = mask_of[static_cast<std::size_t>(geometry.materials[i])];
    (triangle.mask != kNoMask ? masked_ : opaque_).push_back(i);
    if (triangle.mask == kNoMask) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.texture_coordinates[k] = geometry.texture_coordinates[geometry.triangles[i][k]];
    }
    triangles_.push_back(triangle);
  }
}

Cutouts::Query::Query(const Cutouts& cutouts, std::uint32_t masked_triangle)
    : mask_(cutouts.masks_[static_cast<std::size_t>(cutouts.triangles_[masked_triangle].mask)]) {
  const auto& t = cutouts.triangles_[masked_triangle].texture_coordinates;
  origin_ = t[0];
  along_u_ = t[1] - t[0];
  along_v_ = t[2] - t[0];
}

bool Cutouts::Query::solid(float u, float v) const {
  const Eigen::Vector2f at = origin_ + u * along_u_ + v * along_v_;
  // Repeats by whole turns; texel centres lie at half-integers.
  const float x = (at.x() - static_cast<float>(floorOf(at.x()))) * static_cast<float>(mask_.width) - 0.5f;
  const float y = (at.y() - static_cast<float>(floorOf(at.y()))) * static_cast<float>(mask_.height) - 0.5f;
  const int left = floorOf(x);
  const int above = floorOf(y);
  const int x0 = left < 0 ? mask_.width - 1 : left;
  const int y0 = above < 0 ? mask_.height - 1 : above;
  const unsigned square = mask_.square(x0, y0);
  if (square != Mask::kMixed) return square == Mask::kSolid;
  return mask_.interpolated(x0, y0, x - static_cast<float>(left), y - static_cast<float>(above)) >=
         mask_.cutoff;
}

}  // namespace sunlit::light
