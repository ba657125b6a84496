/// Angles of directions, as tables of the sky need them.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit::sky {

constexpr float kHalfPi = static_cast<float>(0.5 * kPi);

/// Arc cosine of x in [0, 1] within 2e-8: Abramowitz and Stegun 1964, 4.4.46. Inlined, and
/// the same bits with every maths library.
inline float arcCosine(float x) {
  float sum = -0.0012624911F;
  for (const float coefficient : {0.0066700901F, -0.0170881256F, 0.0308918810F, -0.0501743046F, 0.0889789874F,
                                  -0.2145988016F, 1.5707963050F}) {
    sum = sum * x + coefficient;
  }
  return std::sqrt(1.0F - x) * sum;
}

/// Elevation of a unit vector, 0 below the horizon, rad.
inline float elevationAboveHorizon(const Eigen::Vector3f& towards) {
  return std::max(0.0F, kHalfPi - arcCosine(std::clamp(towards.z(), 0.0F, 1.0F)));
}

/// Angle between the azimuths of `towards` and of the horizontal unit vector `heading`, 0 … π. Straight up or
/// down, where every azimuth is the same sky, it is 0.
inline float azimuthFrom(const Eigen::Vector2f& heading, const Eigen::Vector3f& towards) {
  const float across = std::sqrt(towards.x() * towards.x() + towards.y() * towards.y());
  const float ahead = across > 0.0F ? (towards.x() * heading.x() + towards.y() * heading.y()) / across : 1.0F;
  const float from_side = arcCosine(std::min(std::abs(ahead), 1.0F));
  return ahead >= 0.0F ? from_side : 2.0F * kHalfPi - from_side;
}

/// The horizontal unit vector below or above `towards`; north where that has no azimuth.
inline Eigen::Vector2f headingOf(const Eigen::Vector3f& towards) {
  const Eigen::Vector2f level = towards.head<2>();
  return level.norm() > 1e-6F ? Eigen::Vector2f(level.normalized()) : Eigen::Vector2f::UnitY();
}

}  // namespace sunlit::sky
