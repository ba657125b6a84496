/// How much of the sun's disc each surface sees.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

class SunDisc {
 public:
  /// Keeps references.
  SunDisc(const sky::DiscLight& sun, const Visibility& visibility, const scene::Scene& scene,
          const Surfaces& surfaces);

  /// False when it gives no light at all.
  bool shines() const { return shines_; }
  const Eigen::Vector3f& towards() const { return towards_; }
  float radius_rad() const { return radius_rad_; }

  /// For each surface of `tile` the share of the disc, 0 … 1, that is above its plane and not hidden,
  /// averaged over its samples. A few rays tell where all is lit or dark; more are cast where they disagree.
  std::vector<float> visibleShares(const Tile& tile) const;

 private:
  struct RayList;
  struct Tally;
  std::vector<bool> worthRefining(const Tile& tile, const std::vector<Tally>& tallies) const;
  int firstRays(const Surface& surface) const;
  void appendRays(const Tile& tile, const Surface& surface, bool refine, RayList* rays) const;
  void cast(const Tile& tile, bool refine, std::vector<Tally>* tallies) const;

  const Visibility& visibility_;
  const scene::Scene& scene_;
  const Surfaces& surfaces_;
  bool shines_;
  Eigen::Vector3f towards_;
  Eigen::Vector3f right_, up_;  ///< span the disc; as long as the tangent of its radius
  float radius_rad_;
};

}  // namespace sunlit::light
