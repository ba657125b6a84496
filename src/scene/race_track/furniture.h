/// What stands along the track: lamps, boards, posts, cones, flags, tents, bridges, yards.
#pragma once

#include "scene/race_track/assembly.h"

namespace sunlit::scene::race_track {

/// Lamps, distance boards, advertisements, chevrons, marshals' posts, cones, flags, bins.
void addFurniture(Assembly& assembly);
/// The gantry at the start line and the bridges over the track.
void addBridges(Assembly& assembly);
/// Tents, parked vehicles and clutter.
void addPaddocks(Assembly& assembly);

}  // namespace sunlit::scene::race_track
