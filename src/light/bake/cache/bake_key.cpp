#include "light/bake/cache/bake_key.h"
#include "sunlit/scene/weathering.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

namespace sunlit::light {
namespace {

void addMaterial(const scene::Material& material, image::ContentHash* hash) {
  for (const float channel : material.base_color.value) hash->add(channel);
  for (const float channel : material.emission.value) hash->add(channel);
  hash->add(material.base_texture);
  hash->add(material.roughness);
  hash->add(material.metalness);
  hash->add(material.transmission);
  hash->add(material.alpha_mode);
  hash->add(material.alpha_cutoff);
  hash->add(static_cast<int>(material.double_sided));
  // What few materials have is added where it is there, behind a name: bakes of worlds without it stay good.
  const auto addMap = [hash](const char* name, const scene::TextureUse& use) {
    if (!use.given()) return;
    hash->addBytes(name, std::strlen(name));
    hash->add(use.texture);
    hash->add(use.coordinates);
    hash->add(use.channel);
  };
  addMap("roughness", material.roughness_map);
  addMap("metalness", material.metalness_map);
  addMap("emission", material.emission_map);
  const scene::Material usual;
  if ((material.dielectric.value != usual.dielectric.value).any() ||
      material.dielectric_grazing != usual.dielectric_grazing) {
    hash->addBytes("dielectric", 10);
    for (const float channel : material.dielectric.value) hash->add(channel);
    hash->add(material.dielectric_grazing);
  }
  if (material.alpha_mode == scene::AlphaMode::kBlend) hash->add(material.alpha);
  if (material.glass > 0.0f) {
    hash->addBytes("glass", 5);
    hash->add(material.glass);
  }
  if (!material.lamp_group.empty()) {
    hash->addBytes("lamp group", 10);
    hash->addBytes(material.lamp_group.data(), material.lamp_group.size());
  }
}

}  // namespace

void addContents(const Geometry& geometry, image::ContentHash* hash) {
  hash->add(geometry.positions);
  hash->add(geometry.normals);
  hash->add(geometry.texture_coordinates);
  for (const auto& more : geometry.more_texture_coordinates) hash->add(more);
  hash->add(geometry.colors);
  hash->add(geometry.triangles);
  hash->add(geometry.materials);
  // Only what the geometry uses: materials of bodies that move follow after those of the scene.
  std::size_t materials = 0, textures = 0;
  for (const std::int32_t used : geometry.materials)
    materials = std::max(materials, static_cast<std::size_t>(used) + 1);
  for (std::size_t i = 0; i < materials; ++i) {
    const scene::Material& material = geometry.scene->materials[i];
    addMaterial(material, hash);
    for (const int texture : {material.base_texture, material.roughness_map.texture,
                              material.metalness_map.texture, material.emission_map.texture})
      textures = std::max(textures, static_cast<std::size_t>(texture + 1));
  }
  for (std::size_t i = 0; i < textures; ++i) {
    const scene::Texture& texture = geometry.scene->textures[i];
    hash->add(texture.width);
    hash->add(texture.height);
    hash->add(texture.rgba);
    if (texture.wrap_u != scene::Wrap::kRepeat || texture.wrap_v != scene::Wrap::kRepeat) {
      hash->add(texture.wrap_u);
      hash->add(texture.wrap_v);
    }
  }
  if (!geometry.weathering) return;
  const scene::SurfaceState& state = geometry.weathering->state();
  hash->addBytes("weathering", 10);
  for (const double value : {state.wet, state.puddles, state.snow_m}) hash->add(value);
  hash->add(state.seed);
}

void addLamps(const std::vector<scene::Lamp>& lamps, image::ContentHash* hash) {
  for (const scene::Lamp& lamp : lamps) {
    for (const Eigen::Vector3f& vector : {lamp.position, lamp.direction})
      for (const float value : vector) hash->add(value);
    for (const float channel : lamp.intensity.value) hash->add(channel);
    for (const float value : {lamp.constant, lamp.linear, lamp.quadratic, lamp.range_m, lamp.inner_rad,
                              lamp.outer_rad, lamp.exponent, lamp.radius_m})
      hash->add(value);
    // Most lamps have no range.
    const std::string fades = !lamp.ends_sharply && std::isfinite(lamp.range_m) ? "fades" : "";
    hash->addBytes(fades.data(), fades.size());
    hash->add(static_cast<int>(lamp.relative));
    hash->add(static_cast<int>(lamp.casts_shadows));
    hash->add(lamp.group);
  }
}

image::ContentHash bakeKey(const Geometry& geometry, const TransportOptions& options) {
  image::ContentHash hash;
  hash.add(kBakeVersion);
  hash.add(options.rays_per_patch);
  hash.add(options.bounces);
  hash.add(finestOf(options, geometry));
  hash.add(options.samples);
  addContents(geometry, &hash);
  addLamps(geometry.scene->lamps, &hash);
  return hash;
}

}  // namespace sunlit::light
