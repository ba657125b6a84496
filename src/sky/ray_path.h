/// Rays through the air of a spherical Earth, bent by it, in steps.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "medium.h"

namespace sunlit::sky {

/// Of a straight ray that just grazes the ground, at `altitude_km`.
inline double horizonCosZenith(double altitude_km) {
  const double ratio = kEarthRadius_km / (kEarthRadius_km + altitude_km);
  return -std::sqrt(std::max(0.0, 1.0 - ratio * ratio));
}

struct Segment {
  double length_km;
  bool hits_ground;
};
/// From `altitude_km` straight to the ground or the top of the atmosphere.
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

/// Whether a ray from `altitude_km` ends at the ground: n r sin ζ is the same all along (Bouguer).
bool hitsGround(const Medium& medium, double altitude_km, double cos_zenith);

/// Distances from the eye that part a line of sight into about `count` steps, short where the air is densest.
std::vector<double> sightEdges(const Medium& medium, double altitude_km, double cos_zenith, int count);

/// A place on a ray, in its plane: x along its azimuth, y up at the eye, km from the Earth's centre.
struct RayPoint {
  Eigen::Vector2d up;         ///< unit
  Eigen::Vector2d direction;  ///< unit; bends
  double altitude_km;
};

/// Where a line of sight begins, and under which angle.
struct SightStart {
  double altitude_km, cos_zenith;
};

/// Follows a ray from the eye over `edges_km`, calls visit(middle, length) for each step, and gives its end.
/// Each step is straight, bent in its middle (exact without refraction, second order with it).
template <typename Visit>
RayPoint followRay(const Medium& medium, const SightStart& start, const std::vector<double>& edges_km,
                   const Visit& visit) {
  const double cos_zenith = start.cos_zenith;
  Eigen::Vector2d place(0.0, kEarthRadius_km + start.altitude_km);
  Eigen::Vector2d direction(std::sqrt(std::max(0.0, 1.0 - cos_zenith * cos_zenith)), cos_zenith);
  const auto pointAt = [&] {
    const double r = place.norm();
    return RayPoint{place / r, direction, r - kEarthRadius_km};
  };
  for (std::size_t i = 0; i + 1 < edges_km.size(); ++i) {
    const double step_km = edges_km[i + 1] - edges_km[i];
    place += direction * (0.5 * step_km);
    const RayPoint middle = pointAt();
    visit(middle, step_km);
    const double bend = medium.refractionPerKm(middle.altitude_km) * step_km;
    if (bend != 0.0) {
      direction += bend * (middle.up - middle.up.dot(direction) * direction);
      direction.normalize();
    }
    place += direction * (0.5 * step_km);
  }
  return pointAt();
}

}  // namespace sunlit::sky
