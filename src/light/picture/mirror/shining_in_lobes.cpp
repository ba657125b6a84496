#include "light/picture/mirror/shining_in_lobes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "light/geometry/ray_list.h"
#include "sunlit/quantity/random.h"

namespace sunlit::light {
namespace {

Eigen::AlignedBox3f boxOf(const Tile& tile, const std::vector<Reflections::Mirroring>& mirrorings) {
  Eigen::AlignedBox3f box;
  for (const Reflections::Mirroring& mirroring : mirrorings) {
    const Surface& surface = tile.surfaces[mirroring.surface];
    if (fillsLobe(surface)) box.extend(surface.position);
  }
  return box;
}

/// Per sr instead of per m².
float perAngle(float per_m2, float distance_m, float cosine) {
  return per_m2 * distance_m * distance_m / std::max(cosine, 1e-6f);
}

}  // namespace

/// Evenly spread over what pixels share at most: see shareLobes().
Eigen::Vector3f ShiningInLobes::numbersOf(std::uint32_t pixel, std::uint32_t rays,
                                          std::uint32_t sample) const {
  constexpr std::uint32_t kAcross = 2 * kLobePixels, kDown = 4 * kLobePixels;
  const std::uint32_t x = pixel % scene_.width, y = pixel / scene_.width;
  const EvenPoints points(scrambled(y / kDown * scene_.width + x / kAcross));
  const std::uint32_t number = (y % kDown * kAcross + x % kAcross) * rays + sample;
  return {points.at(number, 0), points.at(number, 1), points.at(number, 2)};
}

ShiningInLobes::ShiningInLobes(const ShiningList& list, const Scene& scene, const Tile& tile,
                               const std::vector<Reflections::Mirroring>& mirrorings)
    : scene_(scene), tile_(tile), chances_(list, boxOf(tile, mirrorings)) {}

float ShiningInLobes::countedOf(const Ray& ray, const Hit& hit) const {
  const float per_m2 = fillsLobe(ray.surface) ? chances_.density(hit.triangle) : 0.0f;
  if (!(per_m2 > 0.0f)) return 1.0f;
  const Geometry& geometry = scene_.visibility.fixedGeometry();
  const float by_point =
      perAngle(per_m2, hit.distance, std::abs(geometry.planes[hit.triangle].normal.dot(ray.towards)));
  const float by_ray = lobeAt(ray.surface, ray.to_eye, ray.towards).density;
  return by_ray / std::max(by_ray + by_point, 1e-20f);
}

void ShiningInLobes::aim(const Reflections::Mirroring& mirroring, std::uint32_t number, std::uint32_t sample,
                         const Eigen::Vector3f& to_eye) {
  const Surface& surface = tile_.surfaces[mirroring.surface];
  const ShiningList::Point point = chances_.pick(numbersOf(surface.pixel, mirroring.rays, sample));
  const std::size_t at = surface.first_sample + sample;
  const Eigen::Vector3f start = rayStart(tile_, at, surface, point.position - rayStart(tile_, at));
  const Eigen::Vector3f way = point.position - start;
  const float distance_m = way.norm();
  if (!(distance_m > 0.0f) || !(surface.geometric_normal.dot(way) > 0.0f)) return;
  const Eigen::Vector3f towards = way / distance_m;
  const float before = -point.normal.dot(towards);
  if (!(before > 0.0f) && !point.both_sides) return;
  const LobeAt lobe = lobeAt(surface, to_eye, towards);
  if (!(lobe.weighted > 0.0f)) return;
  const float by_point = perAngle(point.density, distance_m, std::abs(before));
  const Eigen::Array3f emission = scene_.vertices.at(point.hit, towards).emission;
  const float clear = 2.0f * rayClearance_m(point.position, distance_m) / distance_m;
  if (!(clear < 1.0f) || !(emission.maxCoeff() > 0.0f)) return;
  sights_.push_back(
      {number, start, (1.0f - clear) * way, emission * (lobe.weighted / (by_point + lobe.density))});
}

void ShiningInLobes::cast(std::vector<Reflections::Mirroring>* mirrorings) {
  thread_local RayList rays;
  thread_local std::vector<std::uint8_t> blocked;
  rays.clear();
  rays.reserve(sights_.size());
  for (std::uint32_t i = 0; i < sights_.size(); ++i) rays.add(i, sights_[i].start, sights_[i].way);
  blocked.resize(rays.size());
  scene_.visibility.occludedWithin(rays.rays(), blocked.data(), Visibility::Blends::kLetPass);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (blocked[i] != 0) continue;
    const Sight& sight = sights_[rays.number()[i]];
    Eigen::Array3f shown = sight.shining;
    if (scene_.glass.anyVeils()) shown *= scene_.glass.throughVeils({sight.start, sight.way, 0.0f, 1.0f});
    (*mirrorings)[sight.number].shining += shown;
  }
}

}  // namespace sunlit::light
