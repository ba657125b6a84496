/// What use and repair leave on the asphalt, and the markings other than the edge lines.
#pragma once

#include "scene/race_track/road_paint.h"

namespace sunlit::scene::race_track {

/// Cracks and their sealing, patches, skid marks, stains, covers, debris.
void addWear(Canvas& canvas, const RoadStretch& stretch);
/// Start line, grid, distances, surveyors' marks.
void addMarkings(Canvas& canvas, const RoadStretch& stretch);

/// From places at the track to the pixels of one stretch.
class StretchMap {
 public:
  StretchMap(const Canvas& canvas, const RoadStretch& stretch);
  Pixel at(double along, double left) const;
  /// The same place, counted in the lap in which it comes nearest to the picture.
  double near(double along) const;
  /// Whether any of from … to is in the picture.
  bool sees(double from, double to) const { return to > from_ && from < to_; }
  float perMetreAlong() const { return along_px_; }
  float perMetreLeft() const { return left_px_; }

 private:
  double from_;
  double to_;
  float along_px_;
  float left_px_;
};

}  // namespace sunlit::scene::race_track
