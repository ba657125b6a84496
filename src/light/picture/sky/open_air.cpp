#include "light/picture/sky/open_air.h"

#include <algorithm>

#include "light/geometry/ray_list.h"
#include "light/patches/sky_patches.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

/// Share of the sky from which on air is lit as in the open.
constexpr float kAsInTheOpen = 0.5f;

/// Smooth, and about the share itself where little is open.
float litBy(float open) {
  const float part = std::clamp(open / kAsInTheOpen, 0.0f, 1.0f);
  return part * part * (3.0f - 2.0f * part);
}

/// Share of the sky above `eye` that nothing hides.
float openAt(const Eigen::Vector3f& eye, const Visibility& visibility) {
  static const SkyPatches patches(1);
  RayList rays;
  rays.reserve(patches.rays().size());
  std::vector<float> solid_angles;
  float all = 0.0f, open = 0.0f;
  for (const SkyPatches::Ray& ray : patches.rays()) {
    if (ray.patch == SkyPatches::kBelow) continue;
    rays.add(0, eye, ray.towards);
    solid_angles.push_back(ray.solid_angle);
    all += ray.solid_angle;
  }
  std::vector<std::uint8_t> blocked(solid_angles.size());
  visibility.occluded(rays.rays(), blocked.data());
  for (std::size_t i = 0; i < blocked.size(); ++i) open += blocked[i] ? 0.0f : solid_angles[i];
  return open / all;
}

}  // namespace

OpenAir::OpenAir(const Surfaces& surfaces, const Visibility& visibility, const std::vector<float>* node_open)
    : node_open_(node_open) {
  if (node_open_) at_eye_ = openAt(surfaces.eye, visibility);
  if (at_eye_ >= kAsInTheOpen) node_open_ = nullptr;
}

float OpenAir::before(const LightPlace& place) const {
  if (!node_open_) return 1.0f;
  float at_surface = 0.0f;
  if (place.known()) {
    for (std::size_t k = 0; k < 3; ++k) at_surface += place.weight[k] * (*node_open_)[place.node[k]];
  }
  return litBy(std::max(at_eye_, at_surface));
}

}  // namespace sunlit::light
