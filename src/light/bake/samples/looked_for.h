/// How light of surfaces close to lamps, so bright that they light others as lamps do, is shared between rays
/// and AreaLights: of a shade, the ceiling above a bulb, the walls of a room that is looked into by its
/// window.
///
/// Rays that look around from a place meet them by chance where they are small, seen from there. So of the
/// light that they pass on straight from a lamp, a share is looked for, as AreaLights, and the rest is met by
/// rays: the more is looked for the farther off they are, in distances between them and the lamp, which is
/// about as wide as what a lamp lights brightly.
#pragma once

#include <algorithm>

namespace sunlit::light {

/// What is farther from its lamp, or from what shines by itself, is not looked for: of lamps it is the walls
/// of a room, of what shines, which rays meet more easily, a housing around it.
constexpr float kFarthestLit_m = 6.0f, kFarthestByShining_m = 1.0f;

/// Share of the light of a lamp at `lamp_m` that is looked for by whoever is far off, 0 … 1.
inline float lookedFor(float lamp_m, float farthest_m = kFarthestLit_m) {
  return std::clamp(2.0f - 2.0f * lamp_m / farthest_m, 0.0f, 1.0f);
}

/// Of that, what is looked for from `from_m`, 0 … 1: a pool of light that is nearer than it is wide is met by
/// some twenty rays. All of what shines by itself.
inline float lookedForFrom(float lamp_m, float from_m) {
  return lamp_m > 0.0f ? std::clamp(from_m / lamp_m - 1.0f, 0.0f, 1.0f) : 1.0f;
}

}  // namespace sunlit::light
