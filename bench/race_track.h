/// The built-in world, as several benchmarks light and draw it.
#pragma once

#include <memory>

#include "sunlit/image/cache_folder.h"
#include "sunlit/light/transport.h"
#include "sunlit/light/world.h"
#include "sunlit/scene/load.h"
#include "sunlit/scene/race_track.h"

namespace sunlit::bench {

inline const light::World& raceTrack() {
  static const light::World world(
      std::make_shared<const scene::Scene>(scene::load(scene::kRaceTrack, scene::SearchPath{})));
  return world;
}

/// With the usual bake, taken from the usual cache or made there first.
inline const light::World& bakedRaceTrack() {
  static const light::World baked = [] {
    light::World world = raceTrack();
    world.transport = light::Transport::cached(world.geometry, {}, image::usualCacheFolder());
    return world;
  }();
  return baked;
}

}  // namespace sunlit::bench
