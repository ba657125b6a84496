/// Houses, barns, the pits and the control tower.
#pragma once

#include "scene/race_track/assembly.h"

namespace sunlit::scene::race_track {

void addBuildings(Assembly& assembly);

}  // namespace sunlit::scene::race_track
