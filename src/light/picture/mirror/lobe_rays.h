/// Where rays of a surface's mirror-like lobe go, so that neighbouring pixels complete each other's.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "sunlit/light/surfaces.h"

namespace sunlit::light {

/// Smoother surfaces mirror a point a sample: the lobe of this one is as wide as the pixel of a camera of 640
/// px and 90°.
constexpr float kSharpest = 0.1f;

/// Pixels across and down whose rays together fill a lobe.
constexpr int kLobePixels = 4;

struct LobeRay {
  Eigen::Vector3f towards;  ///< unit, in `map`, before the surface's shading normal
  float weight;             ///< of what comes from there, relative; 0: nothing does
};

/// Ray of a sample of `surface`, one that mirrors towards `to_eye`, among its pixel's Surface::samples: by
/// the facets that the eye sees, as bright as a dielectric's mirror.
LobeRay lobeRay(const Surface& surface, const Eigen::Vector3f& to_eye, int picture_width,
                std::uint32_t sample);

}  // namespace sunlit::light
