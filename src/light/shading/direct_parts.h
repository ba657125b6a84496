/// What directReflectance() makes of a surface, for loops that meet one surface with many lights.
#pragma once

#include <Eigen/Core>

#include "light/shading/shading.h"

namespace sunlit::light {

struct DirectParts {
  Eigen::Array3f f0;       ///< mirrored by one face at normal incidence
  Eigen::Array3f lambert;  ///< luminance for 1 lx, before Fresnel takes of it
  Eigen::Array3f through;  ///< luminance for 1 lx that falls on the other side
  float grazing;           ///< mirrored by one face at grazing incidence
  float clear;             ///< share that is a clear sheet, of which both faces mirror
};
DirectParts directParts(const Reflection& reflection);

}  // namespace sunlit::light
