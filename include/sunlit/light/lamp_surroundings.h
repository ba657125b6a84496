/// How lamps stand among the surfaces of their world.
#pragma once

#include <string>
#include <vector>

#include "sunlit/light/world.h"

namespace sunlit::light {

/// Fits the lamps of a world that cast shadows to what stands still around them, by rays (own rule):
///   - of one whose light leaves, by a tenth at least of its directions, the ball is made no larger than the
///     room that it has: one right below a ceiling does not reach through it. What shines or is seen through
///     may be its bulb, and is let be;
///   - one that something opaque encloses all around, within a metre, shines through that: Lamp::housing_m.
/// Returns the names of these.
std::vector<std::string> fitToSurroundings(const World& world, std::vector<scene::Lamp>* lamps);

}  // namespace sunlit::light
