/// One condition's light, as far as it does not depend on the camera: made when sun or moon moved, used for
/// many pictures.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "sunlit/sky/daylight.h"

namespace sunlit::light {

struct Illumination {
  /// Without `irradiance`: every surface sees the whole sky that it faces, and no light is bounced.
  Illumination(const sky::Daylight& day_to_use)
      : day(day_to_use) {}  // NOLINT: a Daylight is an open-sky Illumination

  sky::Daylight day;
  /// Of the sky and of what surfaces pass on, at each sample of the Transport that made it; null: open sky.
  std::shared_ptr<const std::vector<Eigen::Array3f>> irradiance;
};

}  // namespace sunlit::light
