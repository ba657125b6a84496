/// What stands where: ground that is taken, so that trees and stones keep off it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "scene/race_track/course.h"

namespace sunlit::scene::race_track {

/// A kind of limit beside the track.
enum class BarrierKind { kGuardRail, kConcrete, kTyres, kHay, kTimber, kNone };

struct BarrierStretch {
  double from;  ///< along, m
  double to;    ///< along, m
  int side;     ///< +1 left, −1 right
  BarrierKind kind;
  bool fence;  ///< chain-link fence behind it
};
/// Both sides all round, in order of `from`.
const std::vector<BarrierStretch>& barriers();

/// Distance of the barrier from the centre line there, m.
double barrierOffset(double along, int side);

/// A building or yard.
struct Plot {
  enum class Kind { kHouse, kPits, kStand, kTower, kPaddock, kBleachers, kBarn } kind;
  TrackPlace place;  ///< of its middle
  double radius;     ///< m, kept free around it
};
const std::vector<Plot>& plots();

/// Whether something so high at `point` would keep the low sun of summer mornings (from azimuth 60°) or
/// evenings (305°) off the stretches of the track that are meant to lie open to it. The rest of the track
/// lies in long shadows then.
bool shadesOpenStretch(const Eigen::Vector2d& point, double height_m);

/// Whether something `radius` m wide at `point` is clear of the track, its barriers and all plots.
bool isFree(const Eigen::Vector2d& point, double radius);

}  // namespace sunlit::scene::race_track
