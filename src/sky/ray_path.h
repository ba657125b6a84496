/// Straight rays through the air of a spherical Earth, in steps.
#pragma once

#include <algorithm>
#include <cmath>

#include "medium.h"

namespace sunlit::sky {

/// Of a ray that just grazes the ground, at `altitude_km`.
inline double horizonCosZenith(double altitude_km) {
  const double ratio = kEarthRadius_km / (kEarthRadius_km + altitude_km);
  return -std::sqrt(std::max(0.0, 1.0 - ratio * ratio));
}

struct Segment {
  double length_km;
  bool hits_ground;
};
/// From `altitude_km` to the ground or the top of the atmosphere.
inline Segment segment(double altitude_km, double cos_zenith) {
  const double r = kEarthRadius_km + altitude_km;
  const double b = r * cos_zenith;
  const double to_ground = b * b - altitude_km * (2.0 * kEarthRadius_km + altitude_km);
  // At zero height, a level ray is not yet a hit.
  if (cos_zenith < 0.0 && to_ground >= 0.0) {
    return {std::max(0.0, -b - std::sqrt(to_ground)), true};
  }
  const double up = kAtmosphereHeight_km - altitude_km;
  const double to_top = b * b + up * (kEarthRadius_km + kAtmosphereHeight_km + r);
  return {-b + std::sqrt(std::max(0.0, to_top)), false};
}

inline double altitudeAlong(double altitude_km, double cos_zenith, double distance_km) {
  const double r = kEarthRadius_km + altitude_km;
  return std::sqrt(r * r + distance_km * (distance_km + 2.0 * r * cos_zenith)) - kEarthRadius_km;
}

/// Calls step(distance, length) for `count` steps from `from_km` to `to_km` along a ray, the shorter the
/// nearer to `from_km`.
template <typename Step>
void march(double from_km, double to_km, int count, const Step& step) {
  const auto edge = [&](int i) {
    const double t = static_cast<double>(i) / count;
    return from_km + (to_km - from_km) * t * t;
  };
  // A range that runs backwards is visited backwards, so that steps always lead away from the eye.
  const bool forwards = to_km >= from_km;
  for (int i = 0; i < count; ++i) {
    const double near_km = forwards ? edge(i) : edge(count - i);
    const double far_km = forwards ? edge(i + 1) : edge(count - i - 1);
    step(0.5 * (near_km + far_km), far_km - near_km);
  }
}

/// Steps along a line of sight from the eye on, short where it is lowest and the air densest.
template <typename Step>
Segment marchSight(double altitude_km, double cos_zenith, int count, const Step& step) {
  const Segment path = segment(altitude_km, cos_zenith);
  const double lowest_km = path.hits_ground ? path.length_km : -(kEarthRadius_km + altitude_km) * cos_zenith;
  if (cos_zenith >= 0.0) {
    march(0.0, path.length_km, count, step);
  } else if (path.hits_ground) {
    march(lowest_km, 0.0, count, step);
  } else {
    march(lowest_km, 0.0, count / 2, step);
    march(lowest_km, path.length_km, count / 2, step);
  }
  return path;
}

}  // namespace sunlit::sky
