#include "light/transport/bake_key.h"

#include <algorithm>

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
}

}  // namespace

void addContents(const Geometry& geometry, image::ContentHash* hash) {
  hash->add(geometry.positions);
  hash->add(geometry.normals);
  hash->add(geometry.texture_coordinates);
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
    textures = std::max(textures, static_cast<std::size_t>(material.base_texture + 1));
  }
  for (std::size_t i = 0; i < textures; ++i) {
    const scene::Texture& texture = geometry.scene->textures[i];
    hash->add(texture.width);
    hash->add(texture.height);
    hash->add(texture.rgba);
  }
}

image::ContentHash bakeKey(const Geometry& geometry, const TransportOptions& options) {
  image::ContentHash hash;
  hash.add(kBakeVersion);
  hash.add(options.rays_per_patch);
  hash.add(options.bounces);
  hash.add(options.finest_m);
  hash.add(options.samples);
  addContents(geometry, &hash);
  return hash;
}

}  // namespace sunlit::light
