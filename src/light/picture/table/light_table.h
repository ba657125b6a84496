/// What lighting needs of a picture's surfaces that does not depend on the light: made once a pose, used for
/// all its conditions.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "light/picture/outlook/outlook.h"
#include "light/shading/shading.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/scene/scene.h"

namespace sunlit::light {

/// Distances at which PictureAir asks for the air: node 0 is at none, where there is no air; what lies beyond
/// the last one, 4194 km, is taken as there.
constexpr int kAirNodes = 46;
float airDistance_m(int node);

class LightTable {
 public:
  /// What a surface shows to a distant disc. Apart from Surface, which is so large that going through all of
  /// them takes as long as their rays.
  struct DiscTarget {
    Eigen::Vector3f geometric_normal, shading_normal;
    float clearance_m;
    std::uint32_t first_sample;
    std::uint16_t x, y;  ///< of its pixel
    std::uint16_t samples;
    bool thin;      ///< light shines through it
    bool leaves;    ///< it has holes, as foliage
    bool gathered;  ///< it is looked at closely: see FinalGather
    bool veiled;    ///< it shares its samples with what it is seen through, or is seen through itself
  };
  /// Between which distances a surface lies.
  struct AirPlace {
    std::int32_t node;  ///< the last one that is not beyond
    float beyond;       ///< 0 … 1, of the way from there to the next
  };
  /// In the order of Tile::surfaces.
  struct Rows {
    std::vector<DiscTarget> targets;
    std::vector<AirPlace> air;
    std::vector<AmbientReflectance> ambient;
    std::uint64_t air_nodes = 0;  ///< that the tile needs, one bit each
  };

  LightTable() = default;
  /// Parallel.
  LightTable(const Surfaces& surfaces, const Outlooks& outlooks, const scene::Scene& scene);

  const Rows& tile(std::size_t number) const { return tiles_[number]; }

 private:
  std::vector<Rows> tiles_;
};

}  // namespace sunlit::light
