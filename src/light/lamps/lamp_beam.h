/// What one lamp gives where nothing is in the way.
#pragma once

#include <Eigen/Geometry>

#include "sunlit/scene/scene.h"

namespace sunlit::light {

class LampBeam {
 public:
  /// `lamp` is not relative.
  explicit LampBeam(const scene::Lamp& lamp);

  const Eigen::Vector3f& position() const { return lamp_.position; }
  float radius_m() const { return lamp_.radius_m; }
  bool castsShadows() const { return lamp_.casts_shadows; }

  /// Illuminance of a plane at `point` that faces the lamp, lx. Within the lamp's ball: as on its surface.
  Eigen::Array3f at(const Eigen::Vector3f& point) const { return lamp_.intensity.value * share(point); }
  /// The largest channel of at().
  float brightestAt(const Eigen::Vector3f& point) const { return brightest_ * share(point); }

  /// Between these lies brightestAt() of all points of a box, whatever is in the way.
  struct Bounds {
    float low, high;
  };
  Bounds within(const Eigen::AlignedBox3f& box) const;

  /// Two unit vectors at right angles to the unit vector `towards` and to each other, the same for equal
  /// `towards`: the disc that the lamp's ball shows lies across them.
  static Eigen::Matrix<float, 3, 2> across(const Eigen::Vector3f& towards);

 private:
  /// Of the intensity.
  float share(const Eigen::Vector3f& point) const;
  /// By distance, within the range.
  float attenuation(float distance_m) const;
  /// By the cosine of the angle to the axis.
  float cone(float cosine) const;

  scene::Lamp lamp_;
  float brightest_;
  float least_m_;  ///< nearer than that nothing gets brighter
  float cos_outer_, per_cosine_;
};

}  // namespace sunlit::light
