/// The one picture of the road, each metre painted on its own.
#pragma once

#include "scene/race_track/canvas.h"
#include "scene/race_track/course.h"

namespace sunlit::scene::race_track {

/// A stretch of the picture: x runs along the track, y from left to right.
struct RoadStretch {
  double from;  ///< along, m, at the left edge of the picture
  double to;    ///< along, m, at its right edge
  int width_px;
};
/// The picture reaches so far to each side of the centre line, m.
constexpr double kPaintedHalfWidth = 7.0;
constexpr int kPaintedHeight_px = 620;

Canvas paintRoad(const RoadStretch& stretch);

}  // namespace sunlit::scene::race_track
