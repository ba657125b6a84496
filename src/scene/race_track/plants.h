/// Trees, bushes, grass and stones.
#pragma once

#include "scene/race_track/foliage.h"

namespace sunlit::scene::race_track {

void addTrees(Assembly& assembly, const Foliage& foliage);
/// Woods on the hills, far from the track.
void addForest(Assembly& assembly, const Foliage& foliage);
void addGrass(Assembly& assembly, const Foliage& foliage);
void addStones(Assembly& assembly);

}  // namespace sunlit::scene::race_track
