/// How much of the sky leaves see, finer than light is sampled.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "light/bake/samples/triangle_kinds.h"
#include "light/bake/samples/work_done.h"
#include "light/patches/sky_openness.h"
#include "light/patches/sky_patches.h"
#include "sunlit/image/kept_array.h"
#include "sunlit/light/geometry.h"

namespace sunlit::light {

/// Cards of leaves cross each other: within a hand's breadth, one may lie open or deep in the shade of the
/// next. So each has a grid of its own, of which patches of the sky are open.
struct LeafOpenness {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  static constexpr std::size_t kNodeBytes = SkyPatches::kCount / 8;

  image::KeptArray<std::uint32_t> first;  ///< of each triangle, into `grids`; kNone: it has none. Or empty
  /// For each grid the number of steps along an edge, and a bit for each patch at each node: node after node
  /// along the third corner's edge, row after row towards the second.
  image::KeptArray<std::uint8_t> grids;

  bool known(std::uint32_t triangle) const { return !first.empty() && first[triangle] != kNone; }
  /// Between the nodes around a point, by its barycentric coordinates, of a triangle that is known().
  PatchBytes patches(std::uint32_t triangle, const std::array<float, 3>& within) const;
  /// The same by sectors of the sky.
  SkyOpenness at(std::uint32_t triangle, const std::array<float, 3>& within) const;
};

/// Parallel; the same for any number of threads. Throws std::runtime_error if the ray library fails or the
/// grids take more than 4 GB.
LeafOpenness leafOpenness(const std::shared_ptr<const Geometry>& geometry,
                          const std::vector<TriangleTraits>& traits, const Progress& progress);

}  // namespace sunlit::light
