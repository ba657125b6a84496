/// All masks of a scene in the form that shaders look them up.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "render/texture_pyramid.h"
#include "sunlit/scene/scene.h"

namespace sunlit::render::gl {

struct MaskTable {
  /// The masks of all materials of `scene` that have one.
  MaskTable(const scene::Scene& scene, const TexturePyramids& pyramids);

  std::vector<std::uint8_t> alpha;  ///< of all sizes of all masks, one after the other
  /// Four a row. Of each mask one row (number of sizes, 0, 0, 0), and one a size (its place in `alpha`,
  /// width, height, least alpha of what is solid), the full one first, whose last are the bits of the float
  /// TexturePyramid::cutoff().
  std::vector<std::int32_t> rows;
  std::unordered_map<const TexturePyramid*, std::int32_t> first_row;
};

}  // namespace sunlit::render::gl
