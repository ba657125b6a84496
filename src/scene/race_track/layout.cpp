#include "scene/race_track/layout.h"

#include <cmath>

#include "scene/noise.h"

namespace sunlit::scene::race_track {

const std::vector<BarrierStretch>& barriers() {
  using K = BarrierKind;
  static const std::vector<BarrierStretch> table = {// Left of the track.
                                                    {-92, 118, 1, K::kConcrete, true},
                                                    {118, 196, 1, K::kHay, false},
                                                    {196, 262, 1, K::kGuardRail, false},
                                                    {262, 282, 1, K::kConcrete, false},
                                                    {282, 322, 1, K::kTyres, true},
                                                    {322, 392, 1, K::kGuardRail, true},
                                                    {392, 452, 1, K::kTimber, false},
                                                    {452, 560, 1, K::kGuardRail, false},
                                                    {560, 618, 1, K::kConcrete, false},
                                                    {618, 654, 1, K::kTyres, true},
                                                    {654, 700, 1, K::kGuardRail, false},
                                                    {700, 772, 1, K::kTimber, false},
                                                    {772, 818, 1, K::kConcrete, true},
                                                    {818, 880, 1, K::kHay, false},
                                                    {880, 938, 1, K::kGuardRail, true},
                                                    // Right of it.
                                                    {-70, 62, -1, K::kConcrete, true},
                                                    {62, 142, -1, K::kGuardRail, true},
                                                    {142, 178, -1, K::kTyres, true},
                                                    {178, 250, -1, K::kConcrete, true},
                                                    {250, 330, -1, K::kTimber, false},
                                                    {330, 396, -1, K::kGuardRail, false},
                                                    {396, 428, -1, K::kTyres, true},
                                                    {428, 506, -1, K::kGuardRail, true},
                                                    {506, 566, -1, K::kConcrete, false},
                                                    {566, 640, -1, K::kGuardRail, false},
                                                    {640, 688, -1, K::kTimber, false},
                                                    {688, 726, -1, K::kTyres, true},
                                                    {726, 806, -1, K::kGuardRail, false},
                                                    {806, 838, -1, K::kConcrete, true},
                                                    {838, 868, -1, K::kTyres, true},
                                                    {868, 960, -1, K::kGuardRail, true}};
  return table;
}

double barrierOffset(double along, int side) {
  const double length = course().length();
  const double angle = 2.0 * M_PI * along / length;
  // Run-off: wider outside of bends, and it wanders a little.
  double bend = 0.0;
  for (int i = -4; i <= 4; ++i) bend += course().curvature(along + 5.0 * i) / 9.0;
  const double outside = std::max(0.0, -side * bend);
  return 8.3 + 60.0 * outside + 0.5 * std::sin(7.0 * angle + side) +
         0.3 * std::sin(19.0 * angle + 2.0 * side);
}

const std::vector<Plot>& plots() {
  using K = Plot::Kind;
  static const std::vector<Plot> table = {
      {K::kPits, {-26, 27}, 40},      {K::kTower, {30, 24}, 8},     {K::kStand, {12, -25}, 36},
      {K::kPaddock, {66, 26}, 22},    {K::kHouse, {158, -27}, 10},  {K::kHouse, {182, -30}, 10},
      {K::kHouse, {210, -25}, 10},    {K::kHouse, {236, -29}, 10},  {K::kHouse, {300, 27}, 10},
      {K::kBleachers, {352, 20}, 14}, {K::kHouse, {398, -28}, 10},  {K::kHouse, {424, -25}, 10},
      {K::kBarn, {468, -30}, 14},     {K::kHouse, {520, -26}, 10},  {K::kHouse, {548, -32}, 10},
      {K::kHouse, {636, 26}, 10},     {K::kPaddock, {586, 25}, 16}, {K::kBleachers, {700, -21}, 14},
      {K::kHouse, {748, -27}, 10},    {K::kBarn, {790, -30}, 14},   {K::kHouse, {842, -28}, 10},
      {K::kHouse, {864, -30}, 10},    {K::kHouse, {905, -27}, 10},  {K::kPaddock, {846, 26}, 16}};
  return table;
}

bool shadesOpenStretch(const Eigen::Vector2d& point, double height_m) {
  struct OpenStretch {
    double from, to;
    bool morning;
  };
  constexpr OpenStretch kStretches[] = {{-30, 50, true},   {160, 190, false}, {305, 340, true},
                                        {480, 520, false}, {610, 640, true},  {840, 890, false}};
  // Azimuth of the sun, and the half width that its path takes in an hour around it, rad; the tangent
  // of 3°.
  constexpr double kMorning = 1.0472;
  constexpr double kEvening = -0.9599;
  constexpr double kHalfWidth_rad = 0.07;
  constexpr double kSlope = 0.0524;
  constexpr double kCrown_m = 3.0;
  for (const OpenStretch& stretch : kStretches) {
    for (double s = stretch.from; s <= stretch.to; s += 12.0) {
      const Eigen::Vector2d d = point - course().point({s, 0.0});
      const double distance = d.norm();
      if (kSlope * distance > height_m) continue;
      const double azimuth = std::atan2(d.x(), d.y());
      const double wide = kHalfWidth_rad + kCrown_m / distance;
      const double sun = stretch.morning ? kMorning : kEvening;
      if (std::abs(std::remainder(azimuth - sun, 2.0 * M_PI)) < wide) return true;
    }
  }
  return false;
}

bool isFree(const Eigen::Vector2d& point, double radius) {
  const TrackPlace place = course().nearest(point);
  const int side = place.left > 0.0 ? 1 : -1;
  if (std::abs(place.left) < barrierOffset(place.along, side) + 1.6 + radius) return false;
  for (const Plot& plot : plots()) {
    const bool wide = plot.kind == Plot::Kind::kPits || plot.kind == Plot::Kind::kStand;
    const Eigen::Vector2d d = point - course().point(plot.place);
    const Eigen::Vector2d t = course().tangent(plot.place.along);
    const double along = std::abs(d.dot(t));
    const double across = std::abs(d.dot(leftOf(t)));
    if (along < plot.radius + radius && across < (wide ? 15.0 : plot.radius) + radius) return false;
  }
  return true;
}

}  // namespace sunlit::scene::race_track
