#include "light/picture/tile_lighting.h"

#include <algorithm>

#include "light/picture/mirror/reflections.h"

namespace sunlit::light {
namespace {

std::unique_ptr<const SurfaceLighting> lightingInMirrors(const SurfaceLighting::Subject& subject,
                                                         const Illumination& light) {
  if (!subject.surfaces.reflections) return nullptr;
  const Surfaces& seen = subject.surfaces.reflections->seen;
  return std::make_unique<const SurfaceLighting>(
      SurfaceLighting::Subject{seen, *seen.table, subject.scene, subject.visibility, true}, light);
}

}  // namespace

TileLighting::TileLighting(const SurfaceLighting::Subject& subject, const Illumination& light)
    : surfaces_(subject.surfaces),
      light_(light),
      lit_(subject, light),
      in_mirrors_(lightingInMirrors(subject, light)),
      air_(surfaces_, subject.table, light.day),
      open_air_(surfaces_, subject.visibility, light.node_open.get()),
      sky_(surfaces_, light.day) {}

void TileLighting::light(const Tile& tile, image::LinearImage* image) const {
  sky_.addTo(tile, image);
  addSurfaces(tile, image);
}

void TileLighting::lightMirrored(std::size_t number, std::vector<SurfaceLighting::SeenByRays>* seen) const {
  seen->clear();
  if (!in_mirrors_) return;
  const Reflections& reflections = *surfaces_.reflections;
  const std::vector<Reflections::Mirroring>& all = reflections.tiles[number];
  if (all.empty()) return;
  thread_local std::vector<Eigen::Array3f> leaving;
  in_mirrors_->light(number, {}, &leaving);
  const std::vector<Surface>& met = reflections.seen.tiles[number].surfaces;
  for (const Reflections::Mirroring& mirroring : all) {
    Eigen::Array3f sum = Eigen::Array3f::Zero();
    for (std::uint32_t i = mirroring.first; i < mirroring.first + mirroring.count; ++i)
      sum += leaving[i] * met[i].share * static_cast<float>(met[i].samples);
    sum /= static_cast<float>(mirroring.rays);
    if (mirroring.sky.maxCoeff() > 0.0f)
      sum += mirroring.sky * light_.day.skyLuminance(mirroring.towards).value;
    seen->push_back({mirroring.surface, mirroring.by_rays, sum});
  }
}

void TileLighting::addSurfaces(const Tile& tile, image::LinearImage* image) const {
  const auto number = static_cast<std::size_t>(&tile - surfaces_.tiles.data());
  thread_local std::vector<SurfaceLighting::SeenByRays> by_rays;
  lightMirrored(number, &by_rays);
  thread_local std::vector<Eigen::Array3f> leaving;
  lit_.light(number, by_rays, &leaving);
  const float weight = 1.0f / static_cast<float>(surfaces_.samples_per_pixel);
  for (std::size_t i = 0; i < tile.surfaces.size(); ++i) {
    const Surface& surface = tile.surfaces[i];
    const sky::AirColumn before = air_.before(number, i);
    const Eigen::Array3f luminance =
        leaving[i] * before.transmittance + open_air_.before(surface) * before.airlight;
    Eigen::Map<Eigen::Array3f> pixel(image->data.data() + 3 * static_cast<std::size_t>(surface.pixel));
    pixel += luminance * (weight * static_cast<float>(surface.samples) * surface.share);
  }
}

}  // namespace sunlit::light
