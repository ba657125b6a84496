/// Light of lamps where rays from bodies met the scene.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "light/lamps/lamp_beam.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {

struct LitPlace {
  Eigen::Vector3f origin;  ///< clear of the surface, m in `map`
  Eigen::Vector3f normal;  ///< unit, of the side that is lit
};

/// What shines at places, and what may stand in the way.
struct LampsOnPlaces {
  const std::vector<LampBeam>& lamps;
  const Visibility& visibility;
};

/// Adds to `illuminance` of each place, lx, which holds all other light, what it gets of the lamps, by a ray
/// to the middle of each. Lamps are left out of a place that would give it less than their share of a
/// hundredth of what it has and all of them would give it, were nothing in their way. Glass passes all.
void addLampLight(const LampsOnPlaces& from, const std::vector<LitPlace>& places,
                  std::vector<Eigen::Array3f>* illuminance);

}  // namespace sunlit::light
