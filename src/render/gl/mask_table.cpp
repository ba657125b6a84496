#include "render/gl/mask_table.h"

#include <cstring>

namespace sunlit::render::gl {

MaskTable::MaskTable(const scene::Scene& scene, const TexturePyramids& pyramids) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    if (!isMasked(scene.materials[i])) continue;
    const TexturePyramid* const pyramid = pyramids.of(static_cast<std::int32_t>(i));
    if (!first_row.emplace(pyramid, static_cast<std::int32_t>(rows.size() / 4)).second) continue;
    const std::vector<TexturePyramid::Mask> masks = pyramid->masks();
    rows.insert(rows.end(), {static_cast<std::int32_t>(masks.size()), 0, 0, 0});
    for (const TexturePyramid::Mask& mask : masks) {
      std::int32_t solid_from = mask.least;
      const float cutoff = pyramid->cutoff();
      if (mask.full) std::memcpy(&solid_from, &cutoff, sizeof(cutoff));
      rows.insert(rows.end(), {static_cast<std::int32_t>(alpha.size()), mask.width, mask.height, solid_from});
      alpha.insert(alpha.end(), mask.alpha, mask.alpha + mask.width * mask.height);
    }
  }
}

}  // namespace sunlit::render::gl
