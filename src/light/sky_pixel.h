/// The sky and the sun's disc as a pixel sees them.
#pragma once

#include <Eigen/Core>

#include "sunlit/light/surfaces.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

class SkyPixel {
 public:
  /// Keeps references.
  SkyPixel(const Surfaces& surfaces, const sky::Daylight& day);

  /// Mean over pixel (x, y), cd/m².
  Eigen::Array3f luminance(int x, int y) const;

 private:
  float discShare(int x, int y) const;

  const Surfaces& surfaces_;
  const sky::Daylight& daylight_;
  Eigen::Vector3f towards_sun_;
  float disc_cosine_;              ///< of the disc's radius
  float near_cosine_;              ///< of the angle beyond which no pixel touches the disc
  Eigen::Array3f disc_luminance_;  ///< cd/m²
};

}  // namespace sunlit::light
