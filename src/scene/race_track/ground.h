/// The lie of the land: heights, the colour of the turf, and the mesh from the verge to the horizon.
#pragma once

#include "scene/race_track/assembly.h"
#include "scene/race_track/course.h"

namespace sunlit::scene::race_track {

/// Height of the visible surface, m: the road on the track, the ground elsewhere. 0 at the origin.
double groundHeight(const Eigen::Vector2d& point);
/// The same by a place at the track.
double groundHeight(const TrackPlace& place);
/// A point on the surface.
Eigen::Vector3f groundPoint(const Eigen::Vector2d& point);
Eigen::Vector3f groundPoint(const TrackPlace& place);

/// Reflectance of turf and bare soil there, without its fine grain.
Color turfColor(const Eigen::Vector2d& point);

/// How far from the centre line the strip along the road reaches, m. Beyond, the open land goes on.
constexpr double kStripHalfWidth = 14.0;

/// The open land. Under the strip along the road it is sunk.
void addLand(Assembly& assembly);

}  // namespace sunlit::scene::race_track
