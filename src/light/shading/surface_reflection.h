/// How a surface of a picture reflects light.
#pragma once

#include "light/shading/shading.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/scene/scene.h"
#include "sunlit/scene/weathering.h"

namespace sunlit::light {

/// Mirrored by one face at normal incidence, of what is not metal, where a share `film` lies under water.
inline Eigen::Array3f dielectricUnder(float film, const scene::Material& material) {
  return material.dielectric.value + film * (scene::Weathering::kFilmReflectance - material.dielectric.value);
}

/// `material` is its own.
inline Reflection reflectionOf(const Surface& surface, const scene::Material& material) {
  return {surface.shading_normal,
          surface.to_eye,
          surface.albedo,
          surface.roughness,
          surface.metalness,
          material.transmission,
          dielectricUnder(surface.film, material),
          material.dielectric_grazing,
          material.glass};
}

}  // namespace sunlit::light
