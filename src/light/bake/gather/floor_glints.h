/// Sun and moon that polished floors throw on walls and ceilings.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "light/bake/gather/through_cloud.h"
#include "light/bake/samples/transport_data.h"
#include "light/patches/disc_area.h"
#include "light/shading/glass_sheets.h"
#include "light/shading/vertex.h"
#include "sunlit/light/visibility.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

/// What each of BakedRooms::glossy gets of one disc by way of such floors: by rays to the disc's picture in
/// the floor, for facets of the floor that are chosen as GGX spreads them, and on from there to the disc.
class FloorGlints {
 public:
  /// Keeps references.
  FloorGlints(const TransportData& data, const sky::DiscLight& disc, const Visibility& visibility,
              const ThroughCloud& through);

  /// Illuminance of each room, lx. Parallel; the same bits for any number of threads.
  void addTo(std::vector<Eigen::Array3f>* rooms) const;

 private:
  /// From a room's point to the floor and on to the disc.
  struct Way {
    std::uint32_t glossy;      ///< of the block
    Eigen::Vector3f origin;    ///< the point
    Eigen::Vector3f to_floor;  ///< unit
    Eigen::Vector3f to_disc;   ///< unit, from there
    float cosine;              ///< between `to_disc` and the facet's normal
    float factor;              ///< illuminance of the point for 1 lx of the disc, without Fresnel and glass
    float area;                ///< that the point stands for
  };
  struct Sum {
    Eigen::Array3f light = Eigen::Array3f::Zero();  ///< times areas
    float areas = 0.0f;
  };
  /// Those of its rays that are cast together, and its number in the block.
  struct Turn {
    std::uint32_t number, first, end;
  };
  void addWays(std::size_t glossy, const Turn& turn, std::vector<Way>* ways) const;
  /// Adds what arrives by `ways`, each to the sum of its room.
  void follow(const std::vector<Way>& ways, Sum* sums) const;

  const TransportData& data_;
  const Visibility& visibility_;
  const ThroughCloud& through_;
  DiscArea disc_;
  Eigen::Array3f illuminance_;
  SceneVertices vertices_;
  GlassSheets glass_;
};

}  // namespace sunlit::light
