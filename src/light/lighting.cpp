#include "sunlit/light/lighting.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "light/tile_lighting.h"

namespace sunlit::light {

image::LinearImage illuminate(const Surfaces& surfaces, const scene::Scene& scene,
                              const Visibility& visibility, const Illumination& light) {
  image::LinearImage image(surfaces.width, surfaces.height);
  const TileLighting lighting(surfaces, scene, visibility, light);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, surfaces.tiles.size()),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) {
                        lighting.light(surfaces.tiles[i], &image);
                      }
                    });
  return image;
}

}  // namespace sunlit::light
