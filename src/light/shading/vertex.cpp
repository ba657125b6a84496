#include "light/shading/vertex.h"

#include <algorithm>
#include <cmath>

#include "light/geometry/ray_start.h"
#include "light/shading/surface_reflection.h"
#include "sunlit/image/srgb.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/scene/weathering.h"
#include "sunlit/scene/wrap.h"

namespace sunlit::light {
namespace {

/// The four texels about a texture coordinate.
struct Texels {
  int x0, x1, y0, y1;
  float fx, fy;
  Texels(const scene::Texture& texture, const Eigen::Vector2f& at) {
    const float x = scene::wrapped(at.x(), texture.wrap_u) * static_cast<float>(texture.width) - 0.5f;
    const float y = scene::wrapped(at.y(), texture.wrap_v) * static_cast<float>(texture.height) - 0.5f;
    const int left = static_cast<int>(std::floor(x));
    const int above = static_cast<int>(std::floor(y));
    fx = x - static_cast<float>(left);
    fy = y - static_cast<float>(above);
    x0 = within(left, texture.width, texture.wrap_u);
    x1 = within(left + 1, texture.width, texture.wrap_u);
    y0 = within(above, texture.height, texture.wrap_v);
    y1 = within(above + 1, texture.height, texture.wrap_v);
  }
  static int within(int i, int size, scene::Wrap wrap) {
    return wrap == scene::Wrap::kRepeat ? (i + size) % size : std::clamp(i, 0, size - 1);
  }
};

template <typename Value>
Value interpolated(const image::ArrayView<Value>& of_vertices, const std::array<std::uint32_t, 3>& corners,
                   const Hit& hit) {
  return (1.0f - hit.u - hit.v) * of_vertices[corners[0]] + hit.u * of_vertices[corners[1]] +
         hit.v * of_vertices[corners[2]];
}

}  // namespace

Vertex seenVertex(const Tile& tile, const Surface& surface, const scene::Scene& scene, std::uint32_t sample) {
  Vertex vertex;
  vertex.material = &scene.materials[static_cast<std::size_t>(surface.material)];
  vertex.reflection = reflectionOf(surface, *vertex.material);
  vertex.emission = surface.emission;
  vertex.film = surface.film;
  vertex.geometric_normal = surface.geometric_normal;
  const std::size_t at = surface.first_sample + sample;
  vertex.front = rayStart(tile, at);
  vertex.behind = vertex.front - 2.0f * surface.clearance_m * surface.geometric_normal;
  return vertex;
}

SceneVertices::SceneVertices(const Geometry& geometry, const Geometry* bodies)
    : geometry_(geometry), bodies_(bodies) {}

SceneVertices::Point SceneVertices::pointOf(const Hit& hit) const {
  const auto fixed = static_cast<std::uint32_t>(geometry_.triangles.size());
  if (hit.triangle < fixed) return {geometry_, hit};
  return {*bodies_, {hit.triangle - fixed, hit.u, hit.v, hit.distance}};
}

const scene::Material& SceneVertices::material(const Hit& hit) const {
  const auto& [geometry, here] = pointOf(hit);
  return geometry.scene->materials[static_cast<std::size_t>(geometry.materials[here.triangle])];
}

Vertex SceneVertices::at(const Hit& at_hit, const Eigen::Vector3f& direction) const {
  const Point point = pointOf(at_hit);
  const auto& [geometry, hit] = point;
  const auto& corners = geometry.triangles[hit.triangle];
  Vertex vertex;
  vertex.material = &geometry.scene->materials[static_cast<std::size_t>(geometry.materials[hit.triangle])];
  const Eigen::Vector3f& front = geometry.planes[hit.triangle].normal;
  vertex.geometric_normal = front.dot(direction) > 0.0f ? Eigen::Vector3f(-front) : front;
  Eigen::Vector3f normal = interpolated(geometry.normals, corners, hit);
  const float length = normal.norm();
  normal = length > 1e-6f ? Eigen::Vector3f(normal / length) : vertex.geometric_normal;
  if (normal.dot(vertex.geometric_normal) < 0.0f) normal = -normal;
  vertex.reflection = {normal,
                       -direction,
                       albedo(point, *vertex.material),
                       roughness(point, *vertex.material),
                       metalness(point, *vertex.material),
                       vertex.material->transmission,
                       vertex.material->dielectric.value,
                       vertex.material->dielectric_grazing,
                       vertex.material->glass};
  const bool shines = vertex.material->double_sided || front.dot(direction) <= 0.0f;
  vertex.emission = shines ? vertex.material->emission.value : Eigen::Array3f(Eigen::Array3f::Zero());
  if (const auto color = texel(point, vertex.material->emission_map, TexelKind::kColor))
    vertex.emission *= *color;
  // Of the corners: far from where the ray started, they tell the place better than its length.
  const Eigen::Vector3f position = interpolated(geometry.positions, corners, hit);
  const Eigen::Vector3f step = rayClearance_m(position, 0.0f) * vertex.geometric_normal;
  vertex.front = position + step;
  vertex.behind = position - step;
  if (geometry.weathering) weather(geometry, position, &vertex);
  return vertex;
}

void SceneVertices::weather(const Geometry& geometry, const Eigen::Vector3f& position, Vertex* vertex) {
  Reflection& reflection = vertex->reflection;
  scene::Weathering::Look look{reflection.albedo, reflection.normal, reflection.roughness,
                               reflection.metalness};
  constexpr float kPoint_m = 0.0f;
  geometry.weathering->apply({position, vertex->geometric_normal, kPoint_m}, *vertex->material, &look);
  reflection.albedo = look.albedo;
  reflection.normal = look.normal;
  reflection.roughness = look.roughness;
  reflection.metalness = look.metalness;
  reflection.dielectric = dielectricUnder(look.film, *vertex->material);
  vertex->film = look.film;
}

std::optional<Eigen::Array3f> SceneVertices::texel(const Point& point, const scene::TextureUse& use,
                                                   TexelKind kind) const {
  const auto& [geometry, hit] = point;
  if (!use.given() || !geometry.coordinates(use.coordinates)) return std::nullopt;
  const scene::Texture& texture = geometry.scene->textures[static_cast<std::size_t>(use.texture)];
  const auto& corners = geometry.triangles[hit.triangle];
  const Texels texels(texture, interpolated(*geometry.coordinates(use.coordinates), corners, hit));
  const std::array<float, 256>& linear = image::linearOfSrgb();
  const auto at = [&](int x, int y) {
    const std::uint8_t* rgba =
        texture.rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(texture.width) +
                                   static_cast<std::size_t>(x));
    if (kind == TexelKind::kData) return Eigen::Array3f(Eigen::Array3f(rgba[0], rgba[1], rgba[2]) / 255.0f);
    return Eigen::Array3f(linear[rgba[0]], linear[rgba[1]], linear[rgba[2]]);
  };
  const Eigen::Array3f top =
      at(texels.x0, texels.y0) * (1.0f - texels.fx) + at(texels.x1, texels.y0) * texels.fx;
  const Eigen::Array3f bottom =
      at(texels.x0, texels.y1) * (1.0f - texels.fx) + at(texels.x1, texels.y1) * texels.fx;
  return Eigen::Array3f(top * (1.0f - texels.fy) + bottom * texels.fy);
}

Eigen::Array3f SceneVertices::albedo(const Point& point, const scene::Material& material) const {
  const auto& [geometry, hit] = point;
  const auto& corners = geometry.triangles[hit.triangle];
  Eigen::Array3f product = material.base_color.value * interpolated(geometry.colors, corners, hit);
  if (const auto color = texel(point, {material.base_texture}, TexelKind::kColor)) product *= *color;
  return product.max(0.0f).min(1.0f);
}

float SceneVertices::roughness(const Point& point, const scene::Material& material) const {
  const auto value = texel(point, material.roughness_map, TexelKind::kData);
  if (!value || material.roughness_map.channel > 2) return material.roughness;
  return std::max(material.roughness * (*value)[material.roughness_map.channel], scene::Material::kSmoothest);
}

float SceneVertices::metalness(const Point& point, const scene::Material& material) const {
  const auto value = texel(point, material.metalness_map, TexelKind::kData);
  if (!value || material.metalness_map.channel > 2) return material.metalness;
  return material.metalness * (*value)[material.metalness_map.channel];
}

}  // namespace sunlit::light
