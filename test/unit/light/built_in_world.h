/// The built-in world, which takes seconds to paint, once a program.
#pragma once

#include "sunlit/scene/race_track.h"

namespace sunlit::light {

inline const scene::Scene& builtInWorld() {
  static const scene::Scene world = scene::raceTrack();
  return world;
}

}  // namespace sunlit::light
