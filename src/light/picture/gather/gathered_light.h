/// Light of the sky as surfaces see it that looked for themselves.
#pragma once

#include <Eigen/Core>

#include "light/patches/patch_sky.h"
#include "light/picture/outlook/outlook.h"

namespace sunlit::light {

/// On both sides of a surface: illuminance by the part of the sky that is open, lx; fourth: the share of the
/// half sphere, by cosine, that is open sky.
struct GatheredLight {
  Eigen::Array4f front, behind;
};

/// `normal` is a unit vector. A sky all alike and open all over gives exactly its share of the half sphere.
GatheredLight gatheredLight(const GatheredSky& gathered, const PatchSky& sky, const Eigen::Vector3f& normal);

}  // namespace sunlit::light
