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

/// A sheet of glass between the frames of a window, as painted, px.
struct Pane {
  Pixel low;
  Pixel high;
  bool barred;  ///< by a bar at half its height

  Pixel barLow() const { return {low.x(), 0.5f * (low.y() + high.y())}; }
  Pixel barHigh() const { return {high.x(), barLow().y() + 1.5f}; }
};

constexpr float kFacadePixelsPerMetre = 30.0f;
/// Of a picture of lit windows: what 1 stands for.
constexpr float kFullWindow_cd_per_m2 = 300.0f;

/// A picture of the whole front, all of one colour.
Canvas emptyFront(const FacadePlan& plan, const Color& color);
/// Where an opening is on a picture of the front that is `canvas_height` px high.
struct OpeningPixels {
  OpeningPixels(const Opening& opening, float canvas_height);
  Pixel low, high;
};

std::vector<Opening> planOpenings(const FacadePlan& plan);
/// Of a window, from left to right.
std::vector<Pane> panesOf(const FacadePlan& plan, const Opening& opening, float canvas_height);
Canvas paintFacade(const FacadePlan& plan, const std::vector<Opening>& openings);
/// What its windows show by night where somebody is in: luminance, where 1 is kFullWindow_cd_per_m2.
Canvas paintLitWindows(const FacadePlan& plan, const std::vector<Opening>& openings);
/// Of what the opening shows on that picture, along its normal, cd; nothing where it is dark.
LinearRgb windowIntensity(const Canvas& lit, const Opening& opening);

}  // namespace sunlit::scene::race_track
