/// Smooth surfaces in rooms, which show what stands before them.
#pragma once

#include <Eigen/Core>

#include "light/bake/samples/met_sample.h"
#include "light/shading/reflectances.h"
#include "sunlit/light/geometry.h"

namespace sunlit::light {

/// Whether a paint mirrors what rays of rooms then look for. Links have no colour, so that gold and copper
/// are none of these: they send all that they reflect evenly.
bool mirrorsRays(const Paint& paint);

/// A ray that goes on from a surface.
struct MirroredRay {
  Eigen::Vector3f origin;   ///< m in `map`, clear of the surface
  Eigen::Vector3f towards;  ///< unit
  float share;              ///< of the luminance along it that the ray before it shows; 0: none
};
/// Of a ray that has met such a `paint`, by one of its facets: by two numbers in [0, 1), evenly spread over
/// many rays.
MirroredRay mirroredRay(const Geometry& geometry, const Paint& paint, const LaneHit& hit,
                        const Eigen::Vector2f& facet);

}  // namespace sunlit::light
