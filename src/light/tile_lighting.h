/// Lights one tile of the picture.
#pragma once

#include <vector>

#include "light/disc_visibility.h"
#include "light/sky_pixel.h"
#include "sunlit/image/images.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

class TileLighting {
 public:
  /// Keeps references to all four. Casts the rays to sun and moon, in parallel.
  TileLighting(const Surfaces& surfaces, const scene::Scene& scene, const Visibility& visibility,
               const Illumination& light);

  /// Writes the pixels of `tile`, and no others.
  void light(const Tile& tile, image::LinearImage* image) const;

 private:
  void addSurfaces(const Tile& tile, image::LinearImage* image) const;
  /// Shares of the discs of sun and moon that a surface sees.
  struct DiscShares {
    float sun, moon;
  };
  Eigen::Array3f luminance(const Surface& surface, const DiscShares& shares) const;

  const Surfaces& surfaces_;
  const scene::Scene& scene_;
  const Illumination& light_;
  DiscVisibility sun_, moon_;
  SkyPixel sky_;
};

}  // namespace sunlit::light
