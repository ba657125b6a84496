/// Where rays of a surface's mirror-like lobe go, so that neighbouring pixels complete each other's.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "sunlit/light/surfaces.h"

namespace sunlit::light {

/// Whether a surface's rays fill its lobe. Smoother ones mirror a point a sample: at this roughness a lobe is
/// as wide as a few pixels of a camera of 640 px and 90°.
inline bool fillsLobe(const Surface& surface) {
  return surface.roughness > 0.1f;
}

/// Pixels across and down of a block, whose rays together fill a lobe.
constexpr int kLobePixels = 4;

/// Pixels as lobes are seen by them.
struct LobePixels {
  std::uint32_t width;  ///< of the picture
  float rad;            ///< of one, in the picture's middle
};
LobePixels lobePixels(const Surfaces& surfaces);

/// Blocks about a pixel whose rays count there: no more than a lobe is wide, and up and down more than
/// across, since most that mirror much are seen from the side.
struct LobeReach {
  std::uint32_t across, down;
};
LobeReach lobeReach(float roughness, const LobePixels& pixels);

/// Rays of a surface: as many as its samples, or fewer where many pixels share them.
std::uint32_t lobeRays(const Surface& surface, const LobePixels& pixels);

struct LobeRay {
  Eigen::Vector3f towards;  ///< unit, in `map`, before the surface's shading normal
  float weight;             ///< of what comes from there, relative; 0: nothing does
};

/// Ray number `ray` of lobeRays() for an eye in direction `to_eye`: by the facets that it sees, as bright as
/// a dielectric's mirror; where fillsLobe() is false, the mirrored direction.
LobeRay lobeRay(const Surface& surface, const Eigen::Vector3f& to_eye, const LobePixels& pixels,
                std::uint32_t ray);

/// A direction, unit, as lobeRay() finds it where fillsLobe() is true: how often, 1/sr; and how bright it
/// shows there, times that: with both 0 light from there is not mirrored.
struct LobeAt {
  float density, weighted;
};
LobeAt lobeAt(const Surface& surface, const Eigen::Vector3f& to_eye, const Eigen::Vector3f& towards);

}  // namespace sunlit::light
