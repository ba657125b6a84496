/// Chain-link fences behind the barriers.
#pragma once

#include "scene/race_track/assembly.h"

namespace sunlit::scene::race_track {

void addFences(Assembly& assembly);

}  // namespace sunlit::scene::race_track
