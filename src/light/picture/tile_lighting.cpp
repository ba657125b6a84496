#include "light/picture/tile_lighting.h"

#include <algorithm>

namespace sunlit::light {
namespace {

std::vector<std::unique_ptr<const SurfaceLighting>> lightingInMirrors(const ReadyPicture& picture,
                                                                      const TileLighting::Surroundings& in,
                                                                      const Illumination& light) {
  std::vector<std::unique_ptr<const SurfaceLighting>> all;
  for (const ReadyMirrors& mirrors : picture.mirrors) {
    all.push_back(std::make_unique<const SurfaceLighting>(
        SurfaceLighting::Subject{mirrors.met, in.scene, in.visibility, true}, light));
  }
  return all;
}

}  // namespace

TileLighting::TileLighting(const ReadyPicture& picture, const Surroundings& in, const Illumination& light)
    : picture_(picture),
      day_(light.day.seenFrom(picture.seen.surfaces.eye)),
      lit_({picture.seen, in.scene, in.visibility}, light),
      in_mirrors_(lightingInMirrors(picture, in, light)),
      air_(picture.seen.surfaces, picture.seen.table, light.day),
      open_air_(picture.seen.surfaces, in.visibility, light.node_open.get()),
      sky_(picture.seen.surfaces, light.day),
      glow_(light.lamps.get(), light.day.fog(), picture.seen.surfaces, in.visibility) {}

void TileLighting::light(std::size_t tile, image::LinearImage* image) const {
  sky_.addTo(picture_.seen.surfaces.tiles[tile], image);
  addSurfaces(tile, image);
  glow_.addTo(picture_.seen.surfaces.tiles[tile], sky_, image);
}

void TileLighting::lightMirrored(std::size_t number, std::size_t depth,
                                 std::vector<SurfaceLighting::SeenByRays>* seen) const {
  seen->clear();
  if (depth >= in_mirrors_.size()) return;
  const ReadyMirrors& mirrors = picture_.mirrors[depth];
  const std::vector<Reflections::Mirroring>& all = mirrors.reflections.tiles[number];
  if (all.empty()) return;
  std::vector<SurfaceLighting::SeenByRays> deeper;
  lightMirrored(number, depth + 1, &deeper);
  thread_local std::vector<Eigen::Array3f> leaving;  // once those within are done
  in_mirrors_[depth]->light(number, deeper, &leaving);
  const std::vector<Surface>& met = mirrors.met.surfaces.tiles[number].surfaces;
  for (const Reflections::Mirroring& mirroring : all) {
    Eigen::Array3f sum = Eigen::Array3f::Zero();
    for (std::uint32_t i = mirroring.first; i < mirroring.first + mirroring.count; ++i)
      sum += leaving[i] * met[i].share * static_cast<float>(met[i].samples);
    sum /= static_cast<float>(mirroring.rays);
    if (mirroring.sky.maxCoeff() > 0.0f) sum += mirroring.sky * day_.skyLuminance(mirroring.towards).value;
    seen->push_back({mirroring.surface, mirroring.by_rays, sum});
  }
}

void TileLighting::addSurfaces(std::size_t number, image::LinearImage* image) const {
  const Surfaces& surfaces = picture_.seen.surfaces;
  const Tile& tile = surfaces.tiles[number];
  const TileOutlooks& outlooks = picture_.seen.outlooks[number];
  thread_local std::vector<SurfaceLighting::SeenByRays> by_rays;
  lightMirrored(number, 0, &by_rays);
  thread_local std::vector<Eigen::Array3f> leaving;
  lit_.light(number, by_rays, &leaving);
  const float weight = 1.0f / static_cast<float>(surfaces.samples_per_pixel);
  for (std::size_t i = 0; i < tile.surfaces.size(); ++i) {
    const Surface& surface = tile.surfaces[i];
    const sky::AirColumn before = air_.before(number, i);
    const Eigen::Array3f luminance =
        leaving[i] * before.transmittance + open_air_.before(outlooks.surfaces[i].light) * before.airlight;
    Eigen::Map<Eigen::Array3f> pixel(image->data.data() + 3 * static_cast<std::size_t>(surface.pixel));
    pixel += luminance * (weight * static_cast<float>(surface.samples) * surface.share);
  }
}

}  // namespace sunlit::light
