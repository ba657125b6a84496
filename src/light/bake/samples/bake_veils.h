/// What rays of the bake see through.
#pragma once

#include <cstdint>
#include <vector>

#include "light/bake/samples/hit_layers.h"
#include "light/bake/samples/masked_group.h"
#include "light/geometry/triangle_mesh.h"
#include "sunlit/light/geometry.h"

namespace sunlit::light {

/// Glass and what blends.
class BakeVeils {
 public:
  /// Keeps a reference to `geometry` and a pointer to the cutouts, and the device alive.
  BakeVeils(const Geometry& geometry, MaskedGroup veils, RTCDevice device);
  BakeVeils(const BakeVeils&) = delete;
  BakeVeils& operator=(const BakeVeils&) = delete;

  /// Adds those on the way to `layers->ends` or as near to these as kSamePlace_m, which rounding alone puts
  /// before them or behind; where next to nothing comes through, all that is left is of a new end.
  void add(const RayPacket& rays, HitLayers* layers) const;
  /// Sets the ends of those rays to −∞ that veils stop by chance.
  void stop(const int* valid, RTCRay16* rays) const;

 private:
  struct Query;  ///< for all of them on the way of a packet's rays
  struct OfRay;
  void put(const OfRay& ray, HitLayers* layers) const;

  MaskedGroup veils_;
  std::vector<std::uint32_t> triangles_;  ///< index into Geometry::triangles, by Embree's number
  ScenePointer scene_;
};

}  // namespace sunlit::light
