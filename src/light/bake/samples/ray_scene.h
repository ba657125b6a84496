/// The scene as rays of the bake meet it.
#pragma once

#include <cstdint>
#include <memory>

#include "light/bake/samples/hit_layers.h"
#include "sunlit/light/geometry.h"

namespace sunlit::light {

/// Surfaces stop light from both sides; masked ones let it through where they are cut out, leaves by smaller
/// triangles of as much area. Glass and what blends are veils: they let a share through.
class RayScene {
 public:
  enum class Facing {
    kTowards,  ///< its front, towards the ray
    kAway,     ///< its back
  };

  /// Keeps `geometry` alive. Throws std::runtime_error if the ray library fails.
  explicit RayScene(std::shared_ptr<const Geometry> geometry);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  const Geometry& geometry() const;

  /// What rays meet first, veils apart.
  void cast(const RayPacket& rays, HitPacket* hits) const;
  /// See BakeVeils.
  void addVeils(const RayPacket& rays, HitLayers* layers) const;
  /// Sets hidden[i] to 1 where a ray meets anything within its reach, else to 0. Veils stop it by chance.
  void hide(const RayPacket& rays, const RayReach& reach, std::uint8_t* hidden) const;
  /// Of what shows the ray one of its sides, and is neither leaf nor veil.
  void castAmong(Facing facing, const RayPacket& rays, const RayReach& reach, HitPacket* hits) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

}  // namespace sunlit::light
