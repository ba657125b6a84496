#include "light/tile_lighting.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sunlit/light/shading.h"

namespace sunlit::light {
namespace {

const std::vector<scene::Lamp>& lampsOf(const Illumination& light) {
  static const std::vector<scene::Lamp> none;
  return light.lamps ? *light.lamps : none;
}

std::vector<bool> glowing(const std::vector<scene::Material>& materials,
                          const std::vector<scene::Lamp>& lamps) {
  std::vector<bool> are;
  for (const scene::Material& material : materials) are.push_back(glows(material, lamps));
  return are;
}

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
      glows_(glowing(subject.scene.materials, lampsOf(light))),
      sun_(light.day.sun(), leastDisc_lx(light.day), {surfaces_, table_, subject.visibility}),
      moon_(light.day.moon(), leastDisc_lx(light.day), {surfaces_, table_, subject.visibility}),
      lamps_(lampsOf(light), light.day.groundIlluminance().value.maxCoeff(),
             {surfaces_, scene_, subject.visibility}),
      air_(surfaces_, table_, light.day),
      open_air_(surfaces_, subject.visibility, light.node_open.get()),
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
  mirrored.assign(std::max<std::size_t>(tile.mirrors.size(), 1), Mirrored());
  if (light_.mirror_sky) {
    for (std::size_t i = 0; i < tile.mirrors.size(); ++i)
      mirrored[i] = mirroredBy(tile.mirrors[i], *light_.mirror_sky);
  }
  thread_local std::vector<Eigen::Array3f> by_lamps;
  lamps_.light(tile, &by_lamps);
  const float weight = 1.0f / static_cast<float>(surfaces_.samples_per_pixel);
  for (std::size_t i = 0; i < tile.surfaces.size(); ++i) {
    const Surface& surface = tile.surfaces[i];
    Eigen::Map<Eigen::Array3f> pixel(image->data.data() + 3 * static_cast<std::size_t>(surface.pixel));
    const SurfaceParts parts{rows.ambient[i],
                             mirrored[rows.mirror[i]],
                             tile.gatheredFor(surface),
                             sun_shares.empty() ? 0.0f : sun_shares[i],
                             moon_shares.empty() ? 0.0f : moon_shares[i],
                             by_lamps.empty() ? nullptr : &by_lamps[i],
                             air_.before(number, i)};
    pixel += luminance(surface, parts) * (weight * static_cast<float>(surface.samples) * surface.share);
  }
}

// The light equation, which doc/equations.md explains, term by term:
//   L = T (Lₑ + Σ f(l) V E + f₊ E₊ + f₋ E₋ + fₘ Lₘ) + Vₐ Lₐ
Eigen::Array3f TileLighting::luminance(const Surface& surface, const SurfaceParts& parts) const {
  const scene::Material& material = scene_.materials[static_cast<std::size_t>(surface.material)];
  const Reflection reflection = reflectionOf(surface, material);
  const auto ofDisc = [&](const DiscVisibility& disc, const sky::DiscLight& lamp,
                          float share) -> Eigen::Array3f {
    return directReflectance(reflection, disc.towards(), disc.radius_rad()) *
           (share * lamp.illuminance.value);
  };
  Eigen::Array3f leaving = Eigen::Array3f::Zero();
  if (glows_[static_cast<std::size_t>(surface.material)]) leaving = surface.emission;
  if (parts.sun > 0.0f) leaving += ofDisc(sun_, light_.day.sun(), parts.sun);
  if (parts.moon > 0.0f) leaving += ofDisc(moon_, light_.day.moon(), parts.moon);
  if (parts.lamps) leaving += *parts.lamps;

  const AmbientReflectance& by = parts.ambient;
  const AmbientLight from =
      ambientLight(surface, {reflection.roughness, parts.mirrored, parts.gathered}, light_);
  const Eigen::Array3f ambient =
      by.diffuse * from.front + by.through * from.behind + by.specular * from.mirrored;
  leaving += surface.cavity * ambient;

  return leaving * parts.before.transmittance + open_air_.before(surface) * parts.before.airlight;
}

}  // namespace sunlit::light
