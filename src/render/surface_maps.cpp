#include "render/surface_maps.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace sunlit::render {
namespace {

/// The mean over a place; false where its coordinates are not known.
bool look(const MapPyramid& pyramid, const scene::TextureUse& use, const SurfaceMaps::Place& place,
          Eigen::Array4f* value) {
  const SurfaceMaps::Place::Coordinates& c = place.sets[static_cast<std::size_t>(use.coordinates)];
  if (!c.known) return false;
  *value = pyramid.mean(TextureArea(c.spot, pyramid.size(), place.filter));
  return true;
}

}  // namespace

void Finish::add(float weight, const Finish& other) {
  emission += weight * other.emission;
  roughness += weight * other.roughness;
  metalness += weight * other.metalness;
  cavity += weight * other.cavity;
}

SurfaceMaps::SurfaceMaps(const scene::Scene& scene, float known_m) : scene_(scene), known_m_(known_m) {
  for (const scene::Material& material : scene.materials) {
    Used used;
    used.roughness = pyramidOf(material.roughness_map, MapPyramid::Kind::kData, &used);
    used.metalness = pyramidOf(material.metalness_map, MapPyramid::Kind::kData, &used);
    used.normals = pyramidOf(material.normal_map, MapPyramid::Kind::kNormals, &used);
    used.occlusion = pyramidOf(material.occlusion_map, MapPyramid::Kind::kData, &used);
    used.emission = pyramidOf(material.emission_map, MapPyramid::Kind::kColor, &used);
    if (material.alpha_mode == scene::AlphaMode::kBlend) {
      const bool any = used.any;
      used.alpha = pyramidOf({material.base_texture, 0, 3}, MapPyramid::Kind::kData, &used);
      used.any = any;  // nothing that a surface is made of
    }
    used_.push_back(used);
  }
  pyramids_.resize(wanted_.size());
  tbb::parallel_for(std::size_t{0}, wanted_.size(), [&](std::size_t i) {
    const auto texture = static_cast<std::size_t>(wanted_[i].texture);
    pyramids_[i] = std::make_unique<MapPyramid>(scene.textures[texture], wanted_[i].kind);
  });
}

int SurfaceMaps::pyramidOf(const scene::TextureUse& use, MapPyramid::Kind kind, Used* used) {
  if (!use.given()) return Used::kNone;
  used->any = true;
  used->sets = std::max(used->sets, use.coordinates + 1);
  const auto same = std::find_if(wanted_.begin(), wanted_.end(), [&](const Wanted& wanted) {
    return wanted.texture == use.texture && wanted.kind == kind;
  });
  const auto index = static_cast<int>(same - wanted_.begin());
  if (same == wanted_.end()) wanted_.push_back({use.texture, kind});
  return index;
}

Finish SurfaceMaps::finish(std::int32_t of_material, const Place& place) const {
  const scene::Material& material = scene_.materials[static_cast<std::size_t>(of_material)];
  const Used& used = used_[static_cast<std::size_t>(of_material)];
  Finish finish{material.emission.value, material.roughness, material.metalness,
                cavity(material, used, place)};
  Eigen::Array4f value;
  const auto pyramid = [&](int index) -> const MapPyramid& {
    return *pyramids_[static_cast<std::size_t>(index)];
  };
  if (used.roughness != Used::kNone && look(pyramid(used.roughness), material.roughness_map, place, &value))
    finish.roughness =
        std::max(material.roughness * value[material.roughness_map.channel], scene::Material::kSmoothest);
  if (used.metalness != Used::kNone && look(pyramid(used.metalness), material.metalness_map, place, &value))
    finish.metalness = material.metalness * value[material.metalness_map.channel];
  if (used.emission != Used::kNone && look(pyramid(used.emission), material.emission_map, place, &value))
    finish.emission *= value.head<3>();
  return finish;
}

float SurfaceMaps::cavity(const scene::Material& material, const Used& used, const Place& place) const {
  Eigen::Array4f value;
  if (used.occlusion == Used::kNone) return 1.0f;
  const scene::TextureUse& use = material.occlusion_map;
  const MapPyramid& pyramid = *pyramids_[static_cast<std::size_t>(used.occlusion)];
  if (!look(pyramid, use, place, &value)) return 1.0f;
  const auto counted = [&](float open) { return 1.0f + material.occlusion_strength * (open - 1.0f); };
  const float open = counted(value[use.channel]);
  if (!(known_m_ > 0.0f)) return open;
  const Place::Coordinates& c = place.sets[static_cast<std::size_t>(use.coordinates)];
  const float texels =
      (c.spot.right * pyramid.size()).matrix().norm() * known_m_ / std::max(place.right_m, 1e-9f);
  const float around = counted(pyramid.at(c.spot.at, roughLog2(std::clamp(texels, 1.0f, 1e6f)))[use.channel]);
  return std::min(open / std::max(around, 1e-3f), 1.0f);
}

bool SurfaceMaps::normal(std::int32_t of_material, const Place& place, Eigen::Vector3f* normal) const {
  const scene::Material& material = scene_.materials[static_cast<std::size_t>(of_material)];
  const Used& used = used_[static_cast<std::size_t>(of_material)];
  Eigen::Array4f value;
  if (used.normals == Used::kNone) return false;
  const MapPyramid& pyramid = *pyramids_[static_cast<std::size_t>(used.normals)];
  if (!look(pyramid, material.normal_map, place, &value)) return false;
  *normal = value.head<3>().matrix();
  if (material.normal_scale == 1.0f) return true;
  // Another scale makes other angles, not another spread.
  const float length = normal->norm();
  normal->head<2>() *= material.normal_scale;
  *normal *= length / std::max(normal->norm(), 1e-6f);
  return true;
}

float SurfaceMaps::alpha(std::int32_t of_material, const Place& place) const {
  const scene::Material& material = scene_.materials[static_cast<std::size_t>(of_material)];
  const int index = used_[static_cast<std::size_t>(of_material)].alpha;
  Eigen::Array4f value;
  if (index == Used::kNone || !look(*pyramids_[static_cast<std::size_t>(index)], {}, place, &value))
    return material.alpha;
  return material.alpha * value[3];
}

int SurfaceMaps::normalCoordinates(std::int32_t material) const {
  return scene_.materials[static_cast<std::size_t>(material)].normal_map.coordinates;
}

float widenedRoughness(float roughness, float mean) {
  constexpr float kRounding = 1e-4f;  // of 16 bits a channel
  if (mean > 1.0f - kRounding) return roughness;
  const float alpha = roughness * roughness;
  const float spread = 2.0f * (1.0f - mean) / std::max(mean, 1e-3f);
  return std::sqrt(std::sqrt(std::min(alpha * alpha + spread, 1.0f)));
}

}  // namespace sunlit::render
