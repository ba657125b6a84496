#include "light/shading/reflectances.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "light/shading/shading.h"
#include "sunlit/image/srgb.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/scene/weathering.h"
#include "sunlit/scene/wrap.h"

namespace sunlit::light {
namespace {

int squareOf(float coordinate, scene::Wrap wrap) {
  return std::min(static_cast<int>(scene::wrapped(coordinate, wrap) * 32.0f), 31);
}

/// Textures that roughness or metalness are taken from.
std::vector<bool> usedAsData(const scene::Scene& scene) {
  std::vector<bool> used(scene.textures.size(), false);
  for (const scene::Material& material : scene.materials) {
    for (const scene::TextureUse& use : {material.roughness_map, material.metalness_map})
      if (use.given()) used[static_cast<std::size_t>(use.texture)] = true;
  }
  return used;
}

}  // namespace

Reflectances::Thumbnail Reflectances::shrink(const scene::Texture& texture, Kind kind) {
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
      const bool data = kind == Kind::kData;
      const float weight = data ? 1.0f : static_cast<float>(rgba[3]) + 1e-3f;
      Eigen::Array3f color(linear[rgba[0]], linear[rgba[1]], linear[rgba[2]]);
      if (data) color = Eigen::Array3f(rgba[0], rgba[1], rgba[2]) / 255.0f;
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
                    [&](std::size_t i) { thumbnails_[i] = shrink(textures[i], Kind::kColor); });
  const std::vector<bool> as_data = usedAsData(*geometry.scene);
  data_thumbnails_.resize(textures.size());
  tbb::parallel_for(std::size_t{0}, textures.size(), [&](std::size_t i) {
    if (as_data[i]) data_thumbnails_[i] = shrink(textures[i], Kind::kData);
  });
}

Paint Reflectances::at(const TriangleSide& side, const Eigen::Vector3f& barycentric) const {
  const std::uint32_t triangle = side.triangle;
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
    albedo *= look(thumbnails_, material.base_texture, uv);
  }
  albedo *= 1.0f - material.glass;  // what goes straight through is not scattered
  const Paint paint{albedo.max(0.0f).min(1.0f),
                    std::max(material.roughness * data(material.roughness_map, triangle, barycentric),
                             scene::Material::kSmoothest),
                    material.metalness * data(material.metalness_map, triangle, barycentric)};
  return geometry_.weathering ? weathered(paint, side, barycentric) : paint;
}

Paint Reflectances::weathered(const Paint& paint, const TriangleSide& side,
                              const Eigen::Vector3f& barycentric) const {
  const std::uint32_t triangle = side.triangle;
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  for (int k = 0; k < 3; ++k)
    position +=
        barycentric[k] * geometry_.positions[geometry_.triangles[triangle][static_cast<std::size_t>(k)]];
  const float sign = side.front ? 1.0f : -1.0f;
  const Eigen::Vector3f face = sign * geometry_.planes[triangle].normal;
  scene::Weathering::Look look{paint.albedo, face, paint.roughness, paint.metalness};
  constexpr float kCell_m = 1.0f;  // about what a place in the bake stands for
  geometry_.weathering->apply(
      {position, face, kCell_m},
      geometry_.scene->materials[static_cast<std::size_t>(geometry_.materials[triangle])], &look);
  return {look.albedo, look.roughness, look.metalness};
}

Eigen::Vector2f Reflectances::coordinates(std::uint32_t triangle, const Eigen::Vector3f& barycentric,
                                          int set) const {
  Eigen::Vector2f uv = Eigen::Vector2f::Zero();
  const std::vector<Eigen::Vector2f>* const of_vertices = geometry_.coordinates(set);
  for (int k = 0; of_vertices && k < 3; ++k)
    uv += barycentric[k] * (*of_vertices)[geometry_.triangles[triangle][static_cast<std::size_t>(k)]];
  return uv;
}

Eigen::Array3f Reflectances::look(const std::vector<Thumbnail>& thumbnails, int texture,
                                  const Eigen::Vector2f& uv) const {
  const auto number = static_cast<std::size_t>(texture);
  const scene::Texture& source = geometry_.scene->textures[number];
  return thumbnails[number].pixels[static_cast<std::size_t>(
      squareOf(uv.y(), source.wrap_v) * Thumbnail::kSize + squareOf(uv.x(), source.wrap_u))];
}

float Reflectances::data(const scene::TextureUse& use, std::uint32_t triangle,
                         const Eigen::Vector3f& barycentric) const {
  if (!use.given() || use.channel > 2 || !geometry_.coordinates(use.coordinates)) return 1.0f;
  return look(data_thumbnails_, use.texture,
              coordinates(triangle, barycentric, use.coordinates))[use.channel];
}

Eigen::Array3f Reflectances::emission(std::uint32_t triangle, const Eigen::Vector3f& barycentric) const {
  const scene::Material& material =
      geometry_.scene->materials[static_cast<std::size_t>(geometry_.materials[triangle])];
  const scene::TextureUse& use = material.emission_map;
  if (!use.given() || !geometry_.coordinates(use.coordinates)) return material.emission.value;
  return material.emission.value *
         look(thumbnails_, use.texture, coordinates(triangle, barycentric, use.coordinates));
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
