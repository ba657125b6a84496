/// What rays of the bake meet first.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "light/bake/samples/covered_faces.h"
#include "light/bake/samples/hit_layers.h"
#include "light/bake/samples/ray_scene.h"
#include "sunlit/light/geometry.h"

namespace sunlit::light {

/// A look from one point at another.
struct BakeSight {
  Eigen::Vector3f origin;  ///< m in `map`
  Eigen::Vector3f way;     ///< to the other, m
  float reach;             ///< share of it that must be free
};

/// As RayScene. A box on the ground has its bottom where the ground is, and which of two faces at one place
/// the ray library finds hangs on the instructions that it uses: here rays from within meet the box's back,
/// not the ground that nobody sees there.
class BakeRays {
 public:
  /// Keeps `geometry` alive. Throws std::runtime_error if the ray library fails.
  explicit BakeRays(std::shared_ptr<const Geometry> geometry);

  void cast(const RayPacket& rays, HitLayers* layers) const;
  /// HitLayers::byChance().
  void cast(const RayPacket& rays, HitPacket* hits) const;
  /// Sets hidden[i] to 1 where something stands in the way of sights[i], else to 0.
  void hide(const std::vector<BakeSight>& sights, std::vector<std::uint8_t>* hidden) const;

 private:
  /// Puts the back of a body where the front that it covers was met.
  void preferBacks(const RayPacket& rays, HitPacket* hits) const;

  RayScene scene_;
  std::vector<Cover> covers_;  ///< see covers()
};

}  // namespace sunlit::light
