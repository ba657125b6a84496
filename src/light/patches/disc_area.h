/// Points of a distant disc.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "light/patches/disc_above_horizon.h"
#include "sunlit/quantity/angle.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

/// The part of a sun or moon that is above the horizon, where its illuminance comes from.
class DiscArea {
 public:
  explicit DiscArea(const sky::DiscLight& disc)
      : towards_(disc.towards.vector().cast<float>()), above_(towards_, disc.angular_radius.rad()) {
    const Eigen::Vector3f across =
        std::abs(towards_.z()) < 0.9f ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitX();
    right_ = across.cross(towards_).normalized() * static_cast<float>(std::tan(disc.angular_radius.rad()));
    up_ = towards_.cross(right_);
  }

  /// Unit, towards the point of it that two numbers in [0, 1) choose, evenly.
  Eigen::Vector3f point(float random_radius, float random_turn) const {
    const float radius = std::sqrt(random_radius), angle = 2.0f * kPiFloat * random_turn;
    const Eigen::Vector2f at =
        above_.place({radius * std::cos(angle), radius * std::sin(angle)}).cast<float>();
    return (towards_ + at.x() * right_ + at.y() * up_).normalized();
  }

 private:
  Eigen::Vector3f towards_;
  DiscAboveHorizon above_;
  Eigen::Vector3f right_, up_;  ///< span it; as long as the tangent of its radius
};

}  // namespace sunlit::light
