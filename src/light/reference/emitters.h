/// Surfaces that shine by themselves, as sources of light that are aimed at.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "sunlit/light/geometry.h"
#include "sunlit/light/visibility.h"

namespace sunlit::light {

/// Solid triangles whose material has emission that belongs to no group of lamps; those with holes are left
/// to chance. Textures are left to who looks at the point.
class Emitters {
 public:
  /// Keeps a reference.
  explicit Emitters(const Geometry& geometry);

  bool any() const { return !triangles_.empty(); }

  struct Point {
    Hit hit;
    Eigen::Vector3f position;
  };
  /// A point, by what triangles give and evenly on them. `random`: in [0, 1).
  Point sample(const std::array<float, 3>& random) const;
  /// With which density sample() chooses what lies at `hit`, seen along the unit vector `towards` at
  /// `distance_m`, 1/sr; 0: never.
  float density(const Hit& hit, const Eigen::Vector3f& towards, float distance_m) const;

 private:
  float luminanceOf(std::uint32_t triangle) const;

  const Geometry& geometry_;
  std::vector<std::uint32_t> triangles_;
  std::vector<double> powers_;  ///< of each of them and all before it: luminance times area
};

}  // namespace sunlit::light
