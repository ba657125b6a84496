/// Painted house fronts, and where their windows and doors are.
#pragma once

#include <vector>

#include "scene/race_track/canvas.h"

namespace sunlit::scene::race_track {

enum class WallKind { kPlaster, kBrick, kTimber, kSheet };

struct FacadePlan {
  float width_m;
  float height_m;
  int floors;
  WallKind kind;
  Color wall;
  bool has_door;
  std::uint32_t seed;
};

/// A rectangle on the front: from the left and the ground, m.
struct Opening {
  float x;
  float z;
  float width;
  float height;
  bool door;
};

constexpr float kFacadePixelsPerMetre = 30.0f;

std::vector<Opening> planOpenings(const FacadePlan& plan);
Canvas paintFacade(const FacadePlan& plan, const std::vector<Opening>& openings);

}  // namespace sunlit::scene::race_track
