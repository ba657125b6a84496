/// Faces that stand on others.
#pragma once

#include <cstdint>
#include <vector>

#include "light/bake/samples/ray_scene.h"

namespace sunlit::light {

/// How much of a face others cover that look the other way, back to back with it, as the bottom of a box does
/// on the ground, by ten places on it.
enum class Cover : std::uint8_t { kNone, kPart, kWhole };

/// By triangle; empty where nothing covers anything.
std::vector<Cover> covers(const RayScene& scene);

/// Whether two faces that look away from one another at one place are the two sides of a wall without
/// thickness, of which whoever looks at either sees its front; else nobody sees them there but from within a
/// body.
inline bool areSidesOfAWall(Cover a, Cover b) {
  return a == Cover::kWhole && b == Cover::kWhole;
}

}  // namespace sunlit::light
