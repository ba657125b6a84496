#include "sunlit/light/lighting.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "light/picture/tile_lighting.h"

namespace sunlit::light {

void prepare(const scene::Scene& scene, Surfaces* surfaces) {
  surfaces->table = std::make_shared<const LightTable>(*surfaces, scene);
}

image::LinearImage illuminate(const Surfaces& surfaces, const scene::Scene& scene,
                              const Visibility& visibility, const Illumination& light) {
  image::LinearImage image(surfaces.width, surfaces.height);
  const std::shared_ptr<const LightTable> table =
      surfaces.table ? surfaces.table : std::make_shared<const LightTable>(surfaces, scene);
  const TileLighting lighting({surfaces, *table, scene, visibility}, light);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, surfaces.tiles.size()),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) {
                        lighting.light(surfaces.tiles[i], &image);
                      }
                    });
  return image;
}

}  // namespace sunlit::light
