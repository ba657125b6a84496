/// Guard rails, walls, tyre stacks, bales and fences along both sides.
#pragma once

#include "scene/race_track/assembly.h"

namespace sunlit::scene::race_track {

void addBarriers(Assembly& assembly);
/// A pile of worn tyres, some of them painted, `count` high.
void addTyreStack(Assembly& assembly, const Eigen::Vector3f& place, int count, Random& random);

}  // namespace sunlit::scene::race_track
