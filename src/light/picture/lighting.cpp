#include "light/picture/lighting.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "light/picture/tile_lighting.h"

namespace sunlit::light {

image::LinearImage illuminate(const ReadyPicture& picture, const scene::Scene& scene,
                              const Visibility& visibility, const Illumination& light) {
  const Surfaces& surfaces = picture.seen.surfaces;
  image::LinearImage image(surfaces.width, surfaces.height);
  const TileLighting lighting(picture, {scene, visibility}, light);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, surfaces.tiles.size()),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) lighting.light(i, &image);
                    });
  return image;
}

}  // namespace sunlit::light
