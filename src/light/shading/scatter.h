/// Random directions in which a surface looks for light.
#pragma once

#include <Eigen/Core>
#include <array>

#include "light/shading/shading.h"

namespace sunlit::light {

struct Scattered {
  Eigen::Vector3f towards;     ///< unit
  Eigen::Array3f reflectance;  ///< directReflectance() of it
  float density;               ///< probability per solid angle, 1/sr; zero: a direction without use
};

/// `random`: three independent numbers in [0, 1). Directions of the Lambert lobe, of the one behind a thin
/// sheet and of the GGX lobe (by normals, Walter et al. 2007, eq. 35-36), weighed together by the balance
/// heuristic (Veach 1997, eq. 9.8).
Scattered scatter(const Reflection& reflection, const std::array<float, 3>& random);

/// With which density scatter() chooses `towards`, 1/sr.
float scatterDensity(const Reflection& reflection, const Eigen::Vector3f& towards);

}  // namespace sunlit::light
