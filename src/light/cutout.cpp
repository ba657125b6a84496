#include "light/cutout.h"

namespace sunlit::light {
namespace {

/// std::floor, which without newer instructions than every x86-64 has is a function call: it took a third of
/// the query.
inline int floorOf(float value) {
  const int truncated = static_cast<int>(value);
  return truncated - (value < static_cast<float>(truncated) ? 1 : 0);
}

}  // namespace

Cutouts::Cutouts(const Geometry& geometry) {
  const scene::Scene& scene = *geometry.scene;
  planes_.resize(scene.textures.size());
  for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i) {
    const scene::Material& material = scene.materials[static_cast<std::size_t>(geometry.materials[i])];
    const bool masked = material.alpha_mode == scene::AlphaMode::kMask &&
                        material.base_texture != scene::Material::kNoTexture;
    (masked ? masked_ : opaque_).push_back(i);
    if (!masked) continue;
    Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.texture_coordinates[k] = geometry.texture_coordinates[geometry.triangles[i][k]];
    }
    triangle.texture = material.base_texture;
    triangle.cutoff = material.alpha_cutoff * 255.0f;
    triangles_.push_back(triangle);

    AlphaPlane& plane = planes_[static_cast<std::size_t>(material.base_texture)];
    if (!plane.alpha.empty()) continue;
    const scene::Texture& texture = scene.textures[static_cast<std::size_t>(material.base_texture)];
    plane.width = texture.width;
    plane.height = texture.height;
    plane.alpha.resize(texture.rgba.size() / 4);
    for (std::size_t p = 0; p < plane.alpha.size(); ++p) plane.alpha[p] = texture.rgba[4 * p + 3];
  }
}

bool Cutouts::solid(std::uint32_t masked_triangle, float u, float v) const {
  const Triangle& triangle = triangles_[masked_triangle];
  const AlphaPlane& plane = planes_[static_cast<std::size_t>(triangle.texture)];
  const auto& t = triangle.texture_coordinates;
  const Eigen::Vector2f at = (1.0f - u - v) * t[0] + u * t[1] + v * t[2];
  // Repeats by whole turns; texel centres lie at half-integers.
  const float x = (at.x() - static_cast<float>(floorOf(at.x()))) * static_cast<float>(plane.width) - 0.5f;
  const float y = (at.y() - static_cast<float>(floorOf(at.y()))) * static_cast<float>(plane.height) - 0.5f;
  const int left = floorOf(x);
  const int above = floorOf(y);
  const int x0 = left < 0 ? plane.width - 1 : left;
  const int y0 = above < 0 ? plane.height - 1 : above;
  const int x1 = x0 + 1 == plane.width ? 0 : x0 + 1;
  const int y1 = y0 + 1 == plane.height ? 0 : y0 + 1;
  const auto alpha = [&plane](int column, int row) {
    return static_cast<float>(
        plane.alpha[static_cast<std::size_t>(row) * static_cast<std::size_t>(plane.width) +
                    static_cast<std::size_t>(column)]);
  };
  const float fx = x - static_cast<float>(left);
  const float fy = y - static_cast<float>(above);
  const float top = alpha(x0, y0) + fx * (alpha(x1, y0) - alpha(x0, y0));
  const float bottom = alpha(x0, y1) + fx * (alpha(x1, y1) - alpha(x0, y1));
  return top + fy * (bottom - top) >= triangle.cutoff;
}

}  // namespace sunlit::light
