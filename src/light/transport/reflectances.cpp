#include "light/transport/reflectances.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sunlit/image/srgb.h"
#include "sunlit/light/shading.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

int wrapped(float coordinate) {
  const float part = coordinate - std::floor(coordinate);
  return std::min(static_cast<int>(part * 32.0f), 31);
}

}  // namespace

Reflectances::Thumbnail Reflectances::shrink(const scene::Texture& texture) {
  const std::array<float, 256>& linear = image::linearOfSrgb();
  Thumbnail small;
  small.pixels.resize(Thumbnail::kSize * Thumbnail::kSize);
  Eigen::Array3f all = Eigen::Array3f::Zero();
  float all_weight = 0.0f;
  std::vector<float> weights(small.pixels.size(), 0.0f);
  for (auto& pixel : small.pixels) pixel.setZero();
  for (int y = 0; y < texture.height; ++y) {
    for (int x = 0; x < texture.width; ++x) {
      const std::uint8_t* rgba =
          texture.rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(texture.width) +
                                     static_cast<std::size_t>(x));
      const float weight = static_cast<float>(rgba[3]) + 1e-3f;
      const Eigen::Array3f color(linear[rgba[0]], linear[rgba[1]], linear[rgba[2]]);
      const auto to = static_cast<std::size_t>(y * Thumbnail::kSize / texture.height * Thumbnail::kSize +
                                               x * Thumbnail::kSize / texture.width);
      small.pixels[to] += weight * color;
      weights[to] += weight;
      all += weight * color;
      all_weight += weight;
    }
  }
  for (std::size_t i = 0; i < small.pixels.size(); ++i) {
    // Textures of less than 32 pixels leave squares empty.
    small.pixels[i] = weights[i] > 0.0f ? Eigen::Array3f(small.pixels[i] / weights[i])
                                        : Eigen::Array3f(all / std::max(all_weight, 1e-6f));
  }
  return small;
}

Reflectances::Reflectances(const Geometry& geometry) : geometry_(geometry) {
  const std::vector<scene::Texture>& textures = geometry.scene->textures;
  thumbnails_.resize(textures.size());
  tbb::parallel_for(std::size_t{0}, textures.size(),
                    [&](std::size_t i) { thumbnails_[i] = shrink(textures[i]); });
}

Paint Reflectances::at(std::uint32_t triangle, const Eigen::Vector3f& barycentric) const {
  const scene::Material& material =
      geometry_.scene->materials[static_cast<std::size_t>(geometry_.materials[triangle])];
  Eigen::Array3f albedo = Eigen::Array3f::Zero();
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t v = geometry_.triangles[triangle][static_cast<std::size_t>(k)];
    albedo += barycentric[k] * geometry_.colors[v];
    uv += barycentric[k] * geometry_.texture_coordinates[v];
  }
  albedo *= material.base_color.value;
  if (material.base_texture != scene::Material::kNoTexture) {
    const Thumbnail& thumbnail = thumbnails_[static_cast<std::size_t>(material.base_texture)];
    albedo *=
        thumbnail.pixels[static_cast<std::size_t>(wrapped(uv.y()) * Thumbnail::kSize + wrapped(uv.x()))];
  }
  return {albedo.max(0.0f).min(1.0f), material.roughness, material.metalness};
}

void Paint::add(float area, const Paint& other) {
  albedo += area * other.albedo;
  roughness += area * other.roughness;
  metalness += area * other.metalness;
}

void Paint::divide(float areas) {
  albedo /= areas;
  roughness /= areas;
  metalness /= areas;
}

Reflectance reflectance(const Paint& paint, float n_v) {
  Reflection reflection;
  reflection.normal = Eigen::Vector3f::UnitZ();
  reflection.to_eye = Eigen::Vector3f(std::sqrt(1.0f - n_v * n_v), 0.0f, n_v);
  reflection.albedo = paint.albedo;
  reflection.roughness = paint.roughness;
  reflection.metalness = paint.metalness;
  const AmbientReflectance ambient = ambientReflectance(reflection);
  return {ambient.diffuse * kPiFloat, ambient.specular};
}

}  // namespace sunlit::light
