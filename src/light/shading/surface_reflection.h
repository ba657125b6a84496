/// How a surface of a picture reflects light.
#pragma once

#include "light/shading/shading.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/scene/scene.h"

namespace sunlit::light {

/// `material` is its own.
inline Reflection reflectionOf(const Surface& surface, const scene::Material& material) {
  return {surface.shading_normal,
          surface.to_eye,
          surface.albedo,
          surface.roughness,
          surface.metalness,
          material.transmission,
          material.dielectric.value,
          material.dielectric_grazing,
          material.glass};
}

}  // namespace sunlit::light
