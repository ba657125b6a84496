#include "light/lamps/lamp_beam.h"

#include <algorithm>
#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit::light {
namespace {

/// Of a cone with a sharp edge, which else would be divided by.
constexpr float kSharpest = 1e-6f;

}  // namespace

LampBeam::LampBeam(const scene::Lamp& lamp)
    : lamp_(lamp),
      brightest_(lamp.intensity.value.maxCoeff()),
      least_m_(std::max(lamp.radius_m, kNearest_m)),
      cos_outer_(std::cos(lamp.outer_rad)),
      per_cosine_(1.0f / std::max(std::cos(lamp.inner_rad) - cos_outer_, kSharpest)) {}

LampBeam::Bounds LampBeam::within(const Eigen::AlignedBox3f& box) const {
  const Eigen::Vector3f middle = box.center() - lamp_.position;
  const float radius = 0.5f * box.diagonal().norm(), distance = middle.norm();
  const float nearest = box.exteriorDistance(lamp_.position), farthest = distance + radius;
  if (nearest > lamp_.range_m) return {0.0f, 0.0f};
  // The angles to the axis that the ball around the box covers.
  float least = 0.0f, most = kPiFloat;
  if (lamp_.isSpot() && distance > radius) {
    const float angle = std::acos(std::clamp(lamp_.direction.dot(middle) / distance, -1.0f, 1.0f));
    const float spread = std::asin(radius / distance);
    least = std::max(angle - spread, 0.0f);
    most = std::min(angle + spread, kPiFloat);
  }
  const float low = farthest > lamp_.range_m ? 0.0f : attenuation(farthest) * cone(std::cos(most));
  return {brightest_ * low, brightest_ * attenuation(nearest) * cone(std::cos(least))};
}

Eigen::Matrix<float, 3, 2> LampBeam::across(const Eigen::Vector3f& towards) {
  const Eigen::Vector3f aside =
      std::abs(towards.z()) < 0.9f ? Eigen::Vector3f::UnitZ() : Eigen::Vector3f::UnitX();
  Eigen::Matrix<float, 3, 2> axes;
  axes.col(0) = aside.cross(towards).normalized();
  axes.col(1) = towards.cross(axes.col(0));
  return axes;
}

}  // namespace sunlit::light
