/// Lights one tile of the picture.
#pragma once

#include <vector>

#include "light/sun_disc.h"
#include "sunlit/image/images.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

class TileLighting {
 public:
  /// Keeps references to all four.
  TileLighting(const Surfaces& surfaces, const scene::Scene& scene, const Visibility& visibility,
               const Illumination& light);

  /// Writes the pixels of `tile`, and no others.
  void light(const Tile& tile, image::LinearImage* image) const;

 private:
  void addSurfaces(const Tile& tile, image::LinearImage* image) const;
  void addSky(const Tile& tile, image::LinearImage* image) const;
  Eigen::Array3f luminance(const Surface& surface, float sun_share) const;

  const Surfaces& surfaces_;
  const scene::Scene& scene_;
  const Illumination& light_;
  SunDisc sun_;
};

}  // namespace sunlit::light
