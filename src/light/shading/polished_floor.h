/// Level floors that show sun and moon as mirrors do, and so throw them on walls and ceilings.
#pragma once

#include "light/shading/direct_parts.h"
#include "light/shading/schlick.h"
#include "light/shading/vertex.h"

namespace sunlit::light {

/// Floors of less roughness are polished: their highlight of the sun is narrower than a patch of the sky.
constexpr float kPolished = 0.25f;
/// Cosine of how far such a floor may be from level: 1°, since a mirror turns light by twice its own turn.
constexpr float kFlat = 0.9998f;

/// Of a vertex that a ray from above met. Metal and glass mirror otherwise.
inline bool isPolishedFloor(const Vertex& vertex) {
  const Reflection& look = vertex.reflection;
  return vertex.geometric_normal.z() > kFlat && look.roughness < kPolished && look.metalness < 0.5f &&
         !(look.transmission > 0.0f) && !(look.glass > 0.0f);
}

/// Fresnel's share of the light that meets its facets at an angle of this cosine.
inline Eigen::Array3f mirroredShare(const Vertex& floor, float cosine) {
  const DirectParts parts = directParts(floor.reflection);
  return parts.f0 + (parts.grazing - parts.f0) * schlick(cosine);
}

}  // namespace sunlit::light
