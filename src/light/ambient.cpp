#include "light/ambient.h"

#include <algorithm>

#include "light/mirror_sky.h"
#include "sunlit/light/body_light.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

Eigen::Array3f atPlace(const LightPlace& place, const std::vector<Eigen::Array3f>& nodes) {
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  for (std::size_t k = 0; k < 3; ++k) sum += place.weight[k] * nodes[place.node[k]];
  return sum;
}

/// Mean luminance of what the mirror-like lobe looks at.
Eigen::Array3f mirrored(const Surface& surface, const Illumination& light) {
  Eigen::Array4f sky = Eigen::Array4f::Zero();
  float open = 0.0f;
  for (std::size_t k = 0; k < MirrorView::kParts; ++k) {
    const auto share = static_cast<float>(surface.mirror.open[k]);
    sky += light.mirror_sky->luminance(surface.mirror.place[k]) * share;
    open += share;
  }
  constexpr float kAll = 255.0f * MirrorView::kParts;
  return sky.head<3>() / kAll + atPlace(surface.light, *light.surroundings) * (1.0f - open / kAll);
}

}  // namespace

Eigen::Array3f ambientLuminance(const Surface& surface, const Reflection& reflection,
                                const Illumination& light) {
  const AmbientReflectance ambient = ambientReflectance(reflection);
  const Eigen::Array3f open = light.day.skyIlluminance(surface.shading_normal).value;
  const bool baked = light.irradiance && surface.light.known();
  const bool moves = light.bodies && surface.body != Surface::kNoBody;
  Eigen::Array3f irradiance = baked ? atPlace(surface.light, *light.irradiance) : open;
  if (moves)
    irradiance = (*light.bodies)[static_cast<std::size_t>(surface.body)].illuminance(surface.shading_normal);
  irradiance *= surface.unhidden;
  const Eigen::Array3f behind =
      baked && !moves && surface.behind.known()
          ? Eigen::Array3f(atPlace(surface.behind, *light.irradiance) * surface.unhidden)
          : irradiance;
  Eigen::Array3f sum = ambient.diffuse * irradiance + ambient.through * behind;
  if (baked && !moves) return sum + ambient.specular * surface.unhidden * mirrored(surface, light);
  // A rough lobe spreads over the hemisphere, a smooth one mirrors a point of the sky.
  const Eigen::Array3f spread = irradiance / static_cast<float>(kPi);
  const float smooth = std::max(0.0f, 1.0f - reflection.roughness * reflection.roughness * 1.5f);
  if (smooth <= 0.0f) return sum + ambient.specular * spread;
  Eigen::Array3f point =
      light.day.skyLuminance(mirrored(surface.to_eye, surface.shading_normal).normalized()).value;
  // What stands around hides the sky in the mirror as it does over the hemisphere.
  if (moves) point *= (irradiance / open.max(1e-9f)).min(1.0f);
  return sum + ambient.specular * (smooth * point + (1.0f - smooth) * spread);
}

}  // namespace sunlit::light
