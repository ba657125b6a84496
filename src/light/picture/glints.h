/// Sun and moon as polished floors throw them on walls and ceilings, in the picture.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "light/picture/disc/disc_visibility.h"
#include "light/picture/disc/floor_mirror.h"
#include "light/picture/ready_picture.h"
#include "light/shading/glass_sheets.h"
#include "sunlit/light/illumination.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

/// A disc's picture in such floors is another disc, seen in the same way, with edges as sharp. Where nodes do
/// not know that light already: see GlintNodes.
class Glints {
 public:
  struct Subject {
    const ReadySurfaces& ready;
    const Visibility& visibility;
    const GlintNodes& nodes;
  };
  /// Null where the disc gives less than `least_lx` on a plane facing it, or no surface wants any of it.
  /// Casts its rays, in parallel. Keeps references.
  static std::unique_ptr<const Glints> of(const sky::DiscLight& disc, float least_lx, const Subject& subject);

  /// Towards the disc's picture, and its angular radius, which the floor's facets widen.
  const Eigen::Vector3f& towards() const { return seen_->towards(); }
  float radius_rad() const { return seen_->radius_rad(); }
  /// What surface `index` of a tile gets on a plane facing it, lx.
  Eigen::Array3f illuminance(std::size_t tile, std::size_t index) const;

 private:
  Glints(const sky::DiscLight& disc, const Subject& subject);
  void look();

  Subject subject_;
  Eigen::Array3f illuminance_;
  Eigen::Vector3f disc_towards_;
  float disc_radius_rad_;
  std::shared_ptr<const FloorMirror> floor_;
  GlassSheets glass_;
  std::unique_ptr<const DiscVisibility> seen_;
};

}  // namespace sunlit::light
