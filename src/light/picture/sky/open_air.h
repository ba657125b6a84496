/// How much daylight reaches the air before what a picture shows: none in a closed room.
#pragma once

#include <cstdint>
#include <vector>

#include "light/bake/samples/light_place.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {

/// Part of the light that air scatters towards the camera, of what it would be under the open sky. The air
/// before a surface is taken to be as open as the more open of its two ends: the camera, by rays to the sky,
/// and the surface, by the bake. So the mouth of a tunnel seen from outside lies behind all of the haze, and
/// so does the land outside seen from within; a wall seen across a room does not.
///
/// Where half of the sky is open, what the rest takes is given back by the surfaces that hide it, which the
/// same sun shines on: there, and beyond, nothing changes.
class OpenAir {
 public:
  /// Keeps references. `node_open` is Illumination::node_open; null: the air is open everywhere.
  OpenAir(const Surfaces& surfaces, const Visibility& visibility, const std::vector<float>* node_open);

  /// Before a surface that finds its light at `place`; 0 … 1.
  float before(const LightPlace& place) const;

 private:
  const std::vector<float>* node_open_;  ///< null: open everywhere
  float at_eye_ = 1.0f;                  ///< share of the sky that the camera sees, by solid angle
};

}  // namespace sunlit::light
