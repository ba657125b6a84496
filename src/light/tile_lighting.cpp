#include "light/tile_lighting.h"

#include <algorithm>
#include <cmath>

#include "light/sky_pixel.h"
#include "sunlit/light/shading.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::light {

TileLighting::TileLighting(const Surfaces& surfaces, const scene::Scene& scene, const Visibility& visibility,
                           const Illumination& light)
    : surfaces_(surfaces), scene_(scene), light_(light), sun_(light.day.sun(), visibility, scene, surfaces) {}

void TileLighting::light(const Tile& tile, image::LinearImage* image) const {
  addSky(tile, image);
  addSurfaces(tile, image);
}

void TileLighting::addSurfaces(const Tile& tile, image::LinearImage* image) const {
  const std::vector<float> sun_shares = sun_.visibleShares(tile);
  const float weight = 1.0f / static_cast<float>(surfaces_.samples_per_pixel);
  for (std::size_t i = 0; i < tile.surfaces.size(); ++i) {
    const Surface& surface = tile.surfaces[i];
    Eigen::Map<Eigen::Array3f> pixel(image->data.data() + 3 * static_cast<std::size_t>(surface.pixel));
    pixel += luminance(surface, sun_shares[i]) * (weight * static_cast<float>(surface.samples));
  }
}

Eigen::Array3f TileLighting::luminance(const Surface& surface, float sun_share) const {
  const scene::Material& material = scene_.materials[static_cast<std::size_t>(surface.material)];
  const Reflection reflection{surface.shading_normal, surface.to_eye, surface.albedo, material.roughness,
                              material.metalness};
  Eigen::Array3f sum = material.emission.value;
  if (sun_share > 0.0f) {
    sum += directReflectance(reflection, sun_.towards(), sun_.radius_rad()) *
           (sun_share * light_.day.sun().illuminance.value);
  }
  const AmbientReflectance ambient = ambientReflectance(reflection);
  const Eigen::Array3f irradiance = light_.day.skyIlluminance(surface.shading_normal).value;
  sum += ambient.diffuse * irradiance;
  // A rough lobe spreads over the hemisphere, a smooth one mirrors a point of the sky.
  const Eigen::Array3f spread = irradiance / static_cast<float>(kPi);
  const float smooth = std::max(0.0f, 1.0f - material.roughness * material.roughness * 1.5f);
  if (smooth <= 0.0f) return sum + ambient.specular * spread;
  const Eigen::Array3f point =
      light_.day.skyLuminance(mirrored(surface.to_eye, surface.shading_normal).normalized()).value;
  return sum + ambient.specular * (smooth * point + (1.0f - smooth) * spread);
}

void TileLighting::addSky(const Tile& tile, image::LinearImage* image) const {
  const SkyPixel sky(surfaces_, light_.day);
  for (int row = 0; row < tile.height; ++row) {
    for (int column = 0; column < tile.width; ++column) {
      const std::uint8_t samples = tile.sky[static_cast<std::size_t>(row * tile.width + column)];
      if (samples == 0) continue;
      const float share = static_cast<float>(samples) / static_cast<float>(surfaces_.samples_per_pixel);
      Eigen::Map<Eigen::Array3f> pixel(image->at(tile.x + column, tile.y + row));
      pixel += sky.luminance(tile.x + column, tile.y + row) * share;
    }
  }
}

}  // namespace sunlit::light
