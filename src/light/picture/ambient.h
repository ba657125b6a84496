/// Light of the sky and of other surfaces, as it arrives at one surface.
#pragma once

#include "light/picture/outlook/outlook.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/surfaces.h"

namespace sunlit::light {

/// What a mirror-like lobe looks at.
struct Mirrored {
  Eigen::Array3f sky = Eigen::Array3f::Zero();  ///< cd/m², mean over the whole lobe
  /// Share of the lobe that other surfaces hide, 0 … 1: of those above the horizon and those below.
  float hidden_above = 1.0f, hidden_below = 0.0f;
};
Mirrored mirroredBy(const Mirror& mirror, const MirrorSky& sky);

/// What the light on a surface depends on beside the surface itself.
struct AmbientSources {
  const WholeOutlook& outlook;  ///< its own
  float roughness;              ///< of its material
  const Mirrored& mirrored;     ///< where the light is baked
};

/// What arrives from all around, without what comes directly from sun and moon.
struct AmbientLight {
  Eigen::Array3f front, behind;  ///< illuminance of the surface and of its other side, lx
  Eigen::Array3f mirrored;       ///< mean luminance of what the mirror-like lobe looks at, cd/m²
};
/// By what is known of the surface: the bake's nodes, and of the sky what was gathered there or leaves
/// know; else, on a body that moves, its surroundings; else the open sky.
AmbientLight ambientLight(const Surface& surface, const AmbientSources& sources, const Illumination& light);

}  // namespace sunlit::light
