#include "light/picture/tile_lighting.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

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
      mirrored_(allMirrored()),
      air_(picture.seen.surfaces, picture.seen.table, day_),
      open_air_(picture.seen.surfaces, in.visibility, light.node_open.get()),
      sky_(picture.seen.surfaces, light.day),
      glow_(light.lamps.get(), day_.fog(), picture.seen.surfaces, in.visibility) {}

void TileLighting::light(std::size_t tile, image::LinearImage* image) const {
  sky_.addTo(picture_.seen.surfaces.tiles[tile], image);
  addSurfaces(tile, image);
  glow_.addTo(picture_.seen.surfaces.tiles[tile], sky_, image);
}

/// What is met in mirrors first, the deepest of all, since it is part of what those before it show.
MirroredLuminances TileLighting::allMirrored() const {
  const std::size_t tiles = picture_.seen.surfaces.tiles.size();
  MirroredLuminances all(tiles);
  for (std::size_t depth = in_mirrors_.size(); depth-- > 0;) {
    const MirroredLuminances deeper = std::exchange(all, MirroredLuminances(tiles));
    tbb::parallel_for(std::size_t{0}, tiles, [&](std::size_t i) {
      lightMirrored({i, depth}, deeper[i], &all[i]);
    });
    const ReadyMirrors& mirrors = picture_.mirrors[depth];
    shareLobes(depth == 0 ? picture_.seen.surfaces : picture_.mirrors[depth - 1].met.surfaces,
               mirrors.reflections, &all);
  }
  return all;
}

void TileLighting::lightMirrored(const TileInMirrors& tile, const std::vector<Eigen::Array3f>& deeper,
                                 std::vector<Eigen::Array3f>* luminances) const {
  const auto [number, depth] = tile;
  const ReadyMirrors& mirrors = picture_.mirrors[depth];
  const Reflections::TileReflections& reflections = mirrors.reflections.tiles[number];
  if (reflections.surfaces.empty()) return;
  thread_local std::vector<Eigen::Array3f> leaving;
  in_mirrors_[depth]->light(number, seenByRays(number, depth + 1, deeper), &leaving);
  const std::vector<Surface>& met = mirrors.met.surfaces.tiles[number].surfaces;
  const Surfaces& before = depth == 0 ? picture_.seen.surfaces : picture_.mirrors[depth - 1].met.surfaces;
  for (const Reflections::Mirroring& mirroring : reflections.surfaces) {
    Eigen::Array3f sum = Eigen::Array3f::Zero();
    if (mirroring.weight > 0.0f) sum = mirroring.shining / mirroring.weight;
    for (std::uint32_t i = mirroring.first; i < mirroring.first + mirroring.count; ++i)
      sum += leaving[i] * met[i].share;
    // Seen from the mirror, which lies in fog that the eye may be above.
    const Eigen::Vector3f& place = before.tiles[number].surfaces[mirroring.surface].position;
    for (std::uint32_t i = mirroring.first_open; i < mirroring.first_open + mirroring.open_count; ++i)
      sum += reflections.open[i].share * day_.skyLuminance(reflections.open[i].towards, place).value;
    luminances->push_back(sum);
  }
}

std::vector<SurfaceLighting::SeenByRays> TileLighting::seenByRays(
    std::size_t number, std::size_t depth, const std::vector<Eigen::Array3f>& luminances) const {
  std::vector<SurfaceLighting::SeenByRays> seen;
  seen.reserve(luminances.size());
  for (std::size_t i = 0; i < luminances.size(); ++i) {
    const Reflections::Mirroring& by = picture_.mirrors[depth].reflections.tiles[number].surfaces[i];
    seen.push_back({by.surface, by.by_rays, luminances[i]});
  }
  return seen;
}

void TileLighting::addSurfaces(std::size_t number, image::LinearImage* image) const {
  const Surfaces& surfaces = picture_.seen.surfaces;
  const Tile& tile = surfaces.tiles[number];
  const TileOutlooks& outlooks = picture_.seen.outlooks[number];
  thread_local std::vector<Eigen::Array3f> leaving;
  lit_.light(number, seenByRays(number, 0, mirrored_[number]), &leaving);
  const float weight = 1.0f / static_cast<float>(surfaces.samples_per_pixel);
  for (std::size_t i = 0; i < tile.surfaces.size(); ++i) {
    const Surface& surface = tile.surfaces[i];
    const sky::AirColumn before = air_.before(number, i);
    const Eigen::Array3f luminance =
        surface.share * leaving[i] * before.transmittance +
        surface.air_share * open_air_.before(outlooks.surfaces[i].light) * before.airlight;
    Eigen::Map<Eigen::Array3f> pixel(image->data.data() + 3 * static_cast<std::size_t>(surface.pixel));
    pixel += luminance * (weight * static_cast<float>(surface.samples));
  }
}

}  // namespace sunlit::light
