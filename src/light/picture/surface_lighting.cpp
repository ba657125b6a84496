#include "light/picture/surface_lighting.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "light/geometry/ray_list.h"
#include "light/geometry/ray_start.h"
#include "light/lamps/beams_of_light.h"
#include "light/patches/least_disc.h"
#include "light/picture/mirror/shining_list.h"
#include "light/shading/direct_parts.h"
#include "light/shading/shading.h"
#include "light/shading/surface_reflection.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

constexpr float kWhole = 0.999f;  ///< of a disc: all of it

const std::vector<scene::Lamp>& lampsOf(const Illumination& light) {
  static const std::vector<scene::Lamp> none;
  return light.lamps ? *light.lamps : none;
}

std::vector<bool> glowing(const SurfaceLighting::Subject& subject, const std::vector<scene::Lamp>& lamps) {
  std::vector<bool> are;
  for (const scene::Material& material : subject.scene.materials)
    are.push_back(glows(material, lamps) && (!subject.in_mirrors || material.lamp_group.empty()));
  return are;
}

std::unique_ptr<const Glints> glintsOf(const sky::DiscLight& disc, const SurfaceLighting::Subject& subject,
                                       const Illumination& light) {
  if (!light.glint_nodes) return nullptr;
  return Glints::of(disc, leastDisc_lx(light.day), {subject.ready, subject.visibility, *light.glint_nodes});
}

}  // namespace

SurfaceLighting::SurfaceLighting(const Subject& subject, const Illumination& light)
    : surfaces_(subject.ready.surfaces),
      outlooks_(subject.ready.outlooks),
      table_(subject.ready.table),
      scene_(subject.scene),
      light_(light),
      glows_(glowing(subject, lampsOf(light))),
      sun_(DiscVisibility::straight(light.day.sun(), leastDisc_lx(light.day), subject.visibility),
           {surfaces_, table_}),
      moon_(DiscVisibility::straight(light.day.moon(), leastDisc_lx(light.day), subject.visibility),
            {surfaces_, table_}),
      sun_glints_(glintsOf(light.day.sun(), subject, light)),
      moon_glints_(glintsOf(light.day.moon(), subject, light)),
      lamps_(beamsOf(light), {surfaces_, scene_, subject.visibility,
                              mirrorsByRays(subject.visibility.fixedGeometry(),
                                            subject.in_mirrors ? Onlooker::kMirrors : Onlooker::kCamera)}),
      visibility_(subject.visibility),
      glass_(subject.visibility),
      broken_cloud_(light.day.hasBrokenCloud()) {}

Eigen::Array3f SurfaceLighting::ofDisc(const Disc& disc, const Tile& tile, std::size_t index) const {
  float share = disc.shares.empty() ? 0.0f : disc.shares[index];
  if (!(share > 0.0f)) return Eigen::Array3f::Constant(share);
  const Surface& surface = tile.surfaces[index];
  if (broken_cloud_) share *= light_.day.throughCloud(disc.light, surface.position);
  if (!glass_.anyVeils()) return Eigen::Array3f::Constant(share);
  return share * (visibility_.hasDarkVeils() && disc.shares[index] < kWhole
                      ? throughAtEdge(disc, tile, surface)
                      : throughVeils(disc, tile, surface));
}

/// By the rays that nothing stops, of four around the disc's middle and each of the surface's samples; none:
/// all are stopped.
std::optional<Eigen::Array3f> SurfaceLighting::throughAround(const Disc& disc, float reach, const Tile& tile,
                                                             const Surface& surface) const {
  constexpr std::uint32_t kPoints = 4;
  const Eigen::Vector3f middle = disc.visibility.towards(), right = middle.unitOrthogonal(),
                        up = middle.cross(right);
  thread_local RayList rays;
  thread_local std::vector<std::uint8_t> blocked;
  rays.clear();
  rays.reserve(kPoints * surface.samples);
  const auto visit = [&](const auto& see) {
    for (std::uint32_t k = 0; k < kPoints * surface.samples; ++k) {
      const float angle = (static_cast<float>(k % kPoints) + 0.5f) * (0.5f * kPiFloat);
      const Eigen::Vector3f aside = std::cos(angle) * right + std::sin(angle) * up;
      const Eigen::Vector3f towards = middle + reach * disc.visibility.radius_rad() * aside;
      see(k, rayStart(tile, surface.first_sample + k / kPoints, surface, towards), towards);
    }
  };
  visit([&](std::uint32_t k, const Eigen::Vector3f& origin, const Eigen::Vector3f& towards) {
    rays.add(k, origin, towards);
  });
  blocked.resize(rays.size());
  visibility_.occluded(rays.rays(), blocked.data(), Visibility::Blends::kLetPass);
  const auto passed = std::count(blocked.begin(), blocked.end(), 0);
  if (passed == 0) return std::nullopt;
  Eigen::Array3f through = Eigen::Array3f::Zero();
  visit([&](std::uint32_t k, const Eigen::Vector3f& origin, const Eigen::Vector3f& towards) {
    if (blocked[k] == 0)
      through += glass_.throughVeils({origin, towards, 0.0f, std::numeric_limits<float>::infinity()});
  });
  return Eigen::Array3f(through / static_cast<float>(passed));
}

Eigen::Array3f SurfaceLighting::throughVeils(const Disc& disc, const Tile& tile,
                                             const Surface& surface) const {
  const Eigen::Vector3f& towards = disc.visibility.towards();
  Eigen::Array3f through = Eigen::Array3f::Zero();
  const std::uint32_t rays = glass_.raysOf(surface.samples);
  for (std::uint32_t k = 0; k < rays; ++k) {
    const Eigen::Vector3f origin = rayStart(tile, surface.first_sample + k, surface, towards);
    through += glass_.throughVeils({origin, towards, 0.0f, std::numeric_limits<float>::infinity()});
  }
  return through / static_cast<float>(rays);
}

Eigen::Array3f SurfaceLighting::throughAtEdge(const Disc& disc, const Tile& tile,
                                              const Surface& surface) const {
  // In radii of the disc: shares are those of pixels around, too, from which some of it is seen.
  for (const float reach : {0.7f, 3.0f, 8.0f, 20.0f, 50.0f}) {
    const std::optional<Eigen::Array3f> through = throughAround(disc, reach, tile, surface);
    if (through) return *through;
  }
  return throughVeils(disc, tile, surface);
}

void SurfaceLighting::addDisc(const Disc& disc, const Tile& tile, ByDiscs* by) const {
  if (disc.shares.empty()) return;
  thread_local std::vector<Reflection> lit;
  thread_local std::vector<std::uint32_t> indices;
  thread_local std::vector<Eigen::Array3f> shares, reflectances;
  lit.clear();
  indices.clear();
  shares.clear();
  for (std::size_t i = 0; i < tile.surfaces.size(); ++i) {
    const Eigen::Array3f share = ofDisc(disc, tile, i);
    if (!(share.maxCoeff() > 0.0f)) continue;
    const Surface& surface = tile.surfaces[i];
    lit.push_back(reflectionOf(surface, scene_.materials[static_cast<std::size_t>(surface.material)]));
    indices.push_back(static_cast<std::uint32_t>(i));
    shares.push_back(share);
  }
  reflectances.resize(lit.size());
  directReflectances(lit, {disc.visibility.towards(), disc.visibility.radius_rad()}, reflectances.data());
  for (std::size_t k = 0; k < lit.size(); ++k) {
    const Eigen::Array3f facing = shares[k] * disc.light.illuminance.value;
    by->luminances[indices[k]] += reflectances[k] * facing;
    by->illuminances[indices[k]] +=
        std::abs(lit[k].normal.dot(disc.visibility.towards())) * facing.maxCoeff();
  }
}

void SurfaceLighting::light(std::size_t number, const std::vector<SeenByRays>& by_rays,
                            std::vector<Eigen::Array3f>* luminances) const {
  const Tile& tile = surfaces_.tiles[number];
  const TileOutlooks& outlooks = outlooks_[number];
  const Disc sun{sun_, light_.day.sun(), sun_.visibleShares(number)};
  const Disc moon{moon_, light_.day.moon(), moon_.visibleShares(number)};
  const LightTable::Rows& rows = table_.tile(number);
  thread_local std::vector<Mirrored> mirrored;
  mirrored.assign(std::max<std::size_t>(outlooks.mirrors.size(), 1), Mirrored());
  if (light_.mirror_sky) {
    for (std::size_t i = 0; i < outlooks.mirrors.size(); ++i)
      mirrored[i] = mirroredBy(outlooks.mirrors[i], *light_.mirror_sky);
  }
  thread_local ByDiscs by_discs;
  by_discs.luminances.assign(tile.surfaces.size(), Eigen::Array3f::Zero());
  by_discs.illuminances.assign(tile.surfaces.size(), 0.0f);
  addDisc(sun, tile, &by_discs);
  addDisc(moon, tile, &by_discs);
  // What each surface gets without lamps.
  std::vector<float>& other_lx = by_discs.illuminances;
  luminances->resize(tile.surfaces.size());
  auto next = by_rays.begin();
  for (std::size_t i = 0; i < tile.surfaces.size(); ++i) {
    const Surface& surface = tile.surfaces[i];
    const bool rays = next != by_rays.end() && next->surface == i;
    const WholeOutlook outlook = outlooks.whole(i);
    const auto glint = [&](const std::unique_ptr<const Glints>& glints,
                           const sky::DiscLight& disc) -> Eigen::Array3f {
      if (!glints) return Eigen::Array3f::Zero();
      const Eigen::Array3f light = glints->illuminance(number, i);
      return broken_cloud_ ? Eigen::Array3f(light * light_.day.throughCloud(disc, surface.position)) : light;
    };
    const AmbientLight around =
        ambientLight(surface, {outlook, surface.roughness, mirrored[outlook.own.mirror]}, light_);
    const SurfaceParts parts{rows.ambient[i],
                             around,
                             by_discs.luminances[i],
                             glint(sun_glints_, sun.light),
                             glint(moon_glints_, moon.light),
                             rays ? &*next++ : nullptr};
    (*luminances)[i] = luminance(surface, parts);
    other_lx[i] += surface.cavity * around.front.max(around.behind).maxCoeff();
  }
  lamps_.addTo(tile, other_lx, luminances);
}

// The light equation, which doc/equations.md explains, term by term, without the air and without lamps:
//   Lₑ + Σ f(l) V E + f₊ E₊ + f₋ E₋ + fₘ Lₘ
Eigen::Array3f SurfaceLighting::luminance(const Surface& surface, const SurfaceParts& parts) const {
  const scene::Material& material = scene_.materials[static_cast<std::size_t>(surface.material)];
  Eigen::Array3f leaving = parts.discs;
  if (glows_[static_cast<std::size_t>(surface.material)]) leaving += surface.emission;
  const auto byFloor = [&](const Glints& glints, const Eigen::Array3f& lux) -> Eigen::Array3f {
    const Reflection reflection = reflectionOf(surface, material);
    Eigen::Array3f all = directReflectance(reflection, glints.towards(), glints.radius_rad());
    if (parts.by_rays) {  // which show the floor, with the disc in it
      const float cosine = std::max(reflection.normal.dot(glints.towards()), 0.0f);
      all -= parts.by_rays->share * (all - all.min(cosine * directParts(reflection).lambert));
    }
    return all * lux;
  };
  if (parts.sun_glint.maxCoeff() > 0.0f) leaving += byFloor(*sun_glints_, parts.sun_glint);
  if (parts.moon_glint.maxCoeff() > 0.0f) leaving += byFloor(*moon_glints_, parts.moon_glint);

  const AmbientReflectance& by = parts.ambient;
  Eigen::Array3f mirrored = parts.around.mirrored;
  if (parts.by_rays) mirrored += parts.by_rays->share * (parts.by_rays->luminance - mirrored);
  const Eigen::Array3f ambient =
      by.diffuse * parts.around.front + by.through * parts.around.behind + by.specular * mirrored;
  return leaving + surface.cavity * ambient;
}

}  // namespace sunlit::light
