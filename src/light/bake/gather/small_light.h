/// Sun or moon as part of the patches of the sky.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "light/patches/sky_patches.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

/// A disc as additional luminance of the patches around it.
struct SmallLight {
  std::array<PatchShare, 4> shares;
  std::array<Eigen::Array3f, 4> luminances;

  explicit SmallLight(const sky::DiscLight& disc) {
    shares = SkyPatches::around(disc.towards.vector().cast<float>());
    for (std::size_t k = 0; k < 4; ++k)
      luminances[k] = disc.illuminance.value * (shares[k].share / SkyPatches::solidAngle(shares[k].patch));
  }
  /// With a row of Coefficients: what arrives, without the row's scale.
  Eigen::Array3f times(const std::uint8_t* row) const {
    Eigen::Array3f sum = Eigen::Array3f::Zero();
    for (std::size_t k = 0; k < 4; ++k) sum += luminances[k] * static_cast<float>(row[shares[k].patch]);
    return sum;
  }
};

}  // namespace sunlit::light
