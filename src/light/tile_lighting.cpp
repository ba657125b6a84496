#include "light/tile_lighting.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sunlit/light/shading.h"

namespace sunlit::light {
namespace {

/// A disc that gives less, on a plane facing it, than a thousandth of what lies on the ground changes no
/// pixel by a visible amount: such as the moon by day.
float leastDisc_lx(const sky::Daylight& day) {
  return 1e-3f * day.groundIlluminance().value.maxCoeff();
}

}  // namespace

TileLighting::TileLighting(const Subject& subject, const Illumination& light)
    : surfaces_(subject.surfaces),
      table_(subject.table),
      scene_(subject.scene),
      light_(light),
      sun_(light.day.sun(), leastDisc_lx(light.day), subject.visibility, table_, surfaces_),
      moon_(light.day.moon(), leastDisc_lx(light.day), subject.visibility, table_, surfaces_),
      air_(surfaces_, table_, light.day),
      sky_(surfaces_, light.day) {}

void TileLighting::light(const Tile& tile, image::LinearImage* image) const {
  sky_.addTo(tile, image);
  addSurfaces(tile, image);
}

void TileLighting::addSurfaces(const Tile& tile, image::LinearImage* image) const {
  const auto number = static_cast<std::size_t>(&tile - surfaces_.tiles.data());
  const std::vector<float>& sun_shares = sun_.visibleShares(number);
  const std::vector<float>& moon_shares = moon_.visibleShares(number);
  const LightTable::Rows& rows = table_.tile(number);
  thread_local std::vector<Mirrored> mirrored;
  mirrored.assign(std::max<std::size_t>(tile.views.size(), 1), Mirrored());
  if (light_.mirror_sky) {
    for (std::size_t i = 0; i < tile.views.size(); ++i)
      mirrored[i] = mirroredBy(tile.views[i], *light_.mirror_sky);
  }
  const float weight = 1.0f / static_cast<float>(surfaces_.samples_per_pixel);
  for (std::size_t i = 0; i < tile.surfaces.size(); ++i) {
    const Surface& surface = tile.surfaces[i];
    Eigen::Map<Eigen::Array3f> pixel(image->data.data() + 3 * static_cast<std::size_t>(surface.pixel));
    const sky::AirColumn before = air_.before(number, i);
    const Eigen::Array3f leaving = luminance(
        surface, {sun_shares.empty() ? 0.0f : sun_shares[i], moon_shares.empty() ? 0.0f : moon_shares[i]},
        {rows.ambient[i], mirrored[rows.view[i]], tile.gatheredFor(surface)});
    const Eigen::Array3f arriving = leaving * before.transmittance + before.airlight;
    pixel += arriving * (weight * static_cast<float>(surface.samples));
  }
}

Eigen::Array3f TileLighting::luminance(const Surface& surface, const DiscShares& shares,
                                       const AmbientParts& parts) const {
  const scene::Material& material = scene_.materials[static_cast<std::size_t>(surface.material)];
  const Reflection reflection = reflectionOf(surface, material);
  Eigen::Array3f sum = material.emission.value;
  if (shares.sun > 0.0f) {
    sum += directReflectance(reflection, sun_.towards(), sun_.radius_rad()) *
           (shares.sun * light_.day.sun().illuminance.value);
  }
  if (shares.moon > 0.0f) {
    sum += directReflectance(reflection, moon_.towards(), moon_.radius_rad()) *
           (shares.moon * light_.day.moon().illuminance.value);
  }
  return sum + ambientLuminance(surface, reflection, parts, light_);
}

}  // namespace sunlit::light
