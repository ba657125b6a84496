/// Light of a straight, thin tube that shines evenly: a line, each part of which gives by the sine of the
/// angle to it, since a cylinder shows as much of itself.
#pragma once

#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit::light {

/// atan(x) to single precision (Abramowitz & Stegun, "Handbook of Mathematical Functions", 1964, 4.4.49, 2e-8
/// for |x| ≤ 1), without a branch.
inline float arcTangent(float x) {
  const float size = std::abs(x), inner = size > 1.0f ? 1.0f / size : size, square = inner * inner;
  const float high =
      -0.0752896400f + square * (0.0429096138f + square * (-0.0161657367f + square * 0.0028662257f));
  const float low =
      -0.3333314528f + square * (0.1999355085f + square * (-0.1420889944f + square * 0.1065626393f));
  const float angle = inner * (1.0f + square * (low + square * square * square * square * high));
  return std::copysign(size > 1.0f ? 0.5f * kPiFloat - angle : angle, x);
}

/// Illuminance by a stretch of the line as a vector, lx for 1 cd a metre straight to the side: that of a
/// plane on whose front all of the stretch lies is its component along the plane's normal.
struct TubeLight {
  float across;  ///< towards the line by the shortest way
  float along;
};

/// At a place `away_m` > 0 from the line, of the stretch from `from_m` to `to_m`, in m from its foot on the
/// line: ∫ ρ (a + u e) / (ρ² + u²)² du, as in Heitz & Hill, "Real-Time Line- and Disk-Light Shading", 2017.
inline TubeLight tubeLight(float away_m, float from_m, float to_m) {
  const float square = away_m * away_m, per_m = 1.0f / away_m;
  const float per_from = 1.0f / (square + from_m * from_m), per_to = 1.0f / (square + to_m * to_m);
  // Their difference as one, since beyond an end they are nearly equal.
  const float opposite = away_m * (to_m - from_m), beside = square + to_m * from_m;
  const float angle = arcTangent(opposite / beside) + (beside < 0.0f ? kPiFloat : 0.0f);
  return {0.5f * (to_m * per_to - from_m * per_from + angle * per_m), 0.5f * away_m * (per_from - per_to)};
}

}  // namespace sunlit::light
