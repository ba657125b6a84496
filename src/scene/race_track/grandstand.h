/// The covered stand on the main straight and the open ones elsewhere, with those who watch.
#pragma once

#include "scene/race_track/assembly.h"

namespace sunlit::scene::race_track {

void addGrandstands(Assembly& assembly);

}  // namespace sunlit::scene::race_track
