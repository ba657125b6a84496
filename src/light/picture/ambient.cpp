#include "light/picture/ambient.h"

#include <algorithm>
#include <array>

#include "light/patches/mirror_sky.h"
#include "light/patches/sky_sectors.h"
#include "light/picture/bodies/body_light.h"
#include "light/picture/gather/gathered_light.h"
#include "light/shading/shading.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

/// What shares of the surfaces above and below the horizon that stand about a place add up to.
Eigen::Array3f aroundOf(const LightPlace& place, const NodeLights& nodes, float above, float below) {
  Eigen::Array4f sum = Eigen::Array4f::Zero();
  for (std::size_t k = 0; k < 3; ++k)
    sum += place.weight[k] * (above * nodes.above(place.node[k]) + below * nodes.below(place.node[k]));
  return sum.head<3>();
}

/// By light of the sky, lx, and the share of the half sphere that it comes from. What hides the rest is as
/// bright as what the nodes have around them.
Eigen::Array3f withSurroundings(const Eigen::Array4f& open, const LightPlace& place, const NodeLights& nodes,
                                float normal_z) {
  const float up = 0.5f * (1.0f + normal_z);  // of an even sphere's light by cosine
  return open.head<3>() + kPiFloat * aroundOf(place, nodes, std::max(up - open[3], 0.0f), 1.0f - up);
}

/// What arrives at a surface and, where light gets through it, behind it.
struct Irradiance {
  Eigen::Array3f front, behind;
};
Irradiance irradianceOf(const Eigen::Vector3f& normal, const AmbientSources& sources,
                        const Illumination& light) {
  const LightPlace& front = sources.outlook.own.light;
  const LightPlace& behind = sources.outlook.sheet.behind;
  const SkyOpenness& sky = sources.outlook.sheet.sky;
  const bool both = behind.known();
  Irradiance sum;
  const auto fromOpenSky = [&](const auto& open) {
    sum.front = withSurroundings(open.front, front, *light.nodes, normal.z());
    if (both) sum.behind = withSurroundings(open.behind, behind, *light.nodes, -normal.z());
  };
  if (sources.outlook.gathered && light.mirror_sky) {
    fromOpenSky(gatheredLight(*sources.outlook.gathered, light.mirror_sky->patches(), normal));
  } else if (sky.known && light.sky_sectors) {
    fromOpenSky(light.sky_sectors->irradiance(sky, normal));
  } else {
    sum.front = irradianceAt(front, *light.nodes);
    if (both) sum.behind = irradianceAt(behind, *light.nodes);
  }
  if (!both) sum.behind = sum.front;
  return sum;
}

/// As the bake knows it.
AmbientLight bakedLight(const Surface& surface, const AmbientSources& sources, const Illumination& light) {
  const Outlook& outlook = sources.outlook.own;
  const Irradiance arriving = irradianceOf(surface.shading_normal, sources, light);
  const Mirrored& mirrored = sources.mirrored;
  const Eigen::Array3f seen =
      mirrored.sky + aroundOf(outlook.light, *light.nodes, mirrored.hidden_above, mirrored.hidden_below);
  return {arriving.front * outlook.unhidden, arriving.behind * outlook.unhidden, seen * outlook.unhidden};
}

/// At a body that moves, as its surroundings tell; null: of the open sky.
AmbientLight unbakedLight(const Surface& surface, const AmbientSources& sources, const AroundLight* body,
                          const Illumination& light) {
  const Eigen::Vector3f& normal = surface.shading_normal;
  const Eigen::Array3f open = light.day.skyIlluminance(normal).value;
  Eigen::Array3f irradiance = open;
  if (body) irradiance = body->illuminance(normal);
  irradiance *= sources.outlook.own.unhidden;
  // A rough lobe spreads over the hemisphere, a smooth one mirrors a point of the sky.
  const Eigen::Array3f spread = irradiance / kPiFloat;
  const float smooth = std::max(0.0f, 1.0f - sources.roughness * sources.roughness * 1.5f);
  if (smooth <= 0.0f) return {irradiance, irradiance, spread};
  Eigen::Array3f point = light.day.skyLuminance(mirrored(surface.to_eye, normal).normalized()).value;
  // What stands around hides the sky in the mirror as it does over the hemisphere.
  if (body) point *= (irradiance / open.max(1e-9f)).min(1.0f);
  return {irradiance, irradiance, smooth * point + (1.0f - smooth) * spread};
}

}  // namespace

Mirrored mirroredBy(const Mirror& mirror, const MirrorSky& sky) {
  Mirrored mirrored;
  if (const auto* rough = std::get_if<RoughMirror>(&mirror)) {
    mirrored.sky = rough->tint.times(sky.patches().times(rough->share.data()) * rough->scale);
    mirrored.hidden_above = rough->hidden_above;
    mirrored.hidden_below = rough->hidden_below;
  } else {
    const auto& smooth = std::get<SmoothMirror>(mirror);
    Eigen::Array4f sum = Eigen::Array4f::Zero();
    float open = 0.0f;
    for (std::size_t k = 0; k < SmoothMirror::kParts; ++k) {
      const auto share = static_cast<float>(smooth.open[k]);
      sum += sky.luminance(smooth.place[k]) * share;
      open += share;
    }
    constexpr float kAll = 255.0f * SmoothMirror::kParts;
    mirrored.sky = smooth.tint.times(sum.head<3>() / kAll);
    mirrored.hidden_above = std::max(1.0f - open / kAll - smooth.hidden_below, 0.0f);
    mirrored.hidden_below = smooth.hidden_below;
  }
  return mirrored;
}

AmbientLight ambientLight(const Surface& surface, const AmbientSources& sources, const Illumination& light) {
  const Outlook& outlook = sources.outlook.own;
  const bool moves = light.bodies && outlook.body != Outlook::kNoBody;
  if (light.nodes && outlook.light.known() && !moves) return bakedLight(surface, sources, light);
  const AroundLight* const body = moves ? &(*light.bodies)[static_cast<std::size_t>(outlook.body)] : nullptr;
  return unbakedLight(surface, sources, body, light);
}

}  // namespace sunlit::light
