/// Where anything stands on the ground.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include "light/bake/samples/triangle_kinds.h"
#include "sunlit/light/geometry.h"

namespace sunlit::light {

/// On a map of squares.
class Occupancy {
 public:
  Occupancy(const Geometry& geometry, const std::vector<TriangleTraits>& traits);

  /// Longest edge of a cell within `box`, m: no car may lie unseen amid it.
  float coarsest_m(const Eigen::AlignedBox3f& box) const;

 private:
  bool anythingNear(const Eigen::AlignedBox3f& box) const;

  float emptiest_m_;                           ///< longest edge where nothing stands
  std::unordered_set<std::uint64_t> squares_;  ///< on which something does
};

}  // namespace sunlit::light
