/// Lights one tile of the picture.
#pragma once

#include <memory>
#include <vector>

#include "light/picture/sky/open_air.h"
#include "light/picture/sky/picture_air.h"
#include "light/picture/sky/sky_pixel.h"
#include "light/picture/surface_lighting.h"
#include "light/picture/table/light_table.h"
#include "sunlit/image/images.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

class TileLighting {
 public:
  /// Keeps references. Casts the rays to sun and moon, in parallel.
  TileLighting(const SurfaceLighting::Subject& subject, const Illumination& light);

  /// Writes the pixels of `tile`, and no others.
  void light(const Tile& tile, image::LinearImage* image) const;

 private:
  void addSurfaces(const Tile& tile, image::LinearImage* image) const;
  /// What the tile's mirroring surfaces see by their rays.
  void lightMirrored(std::size_t tile, std::vector<SurfaceLighting::SeenByRays>* seen) const;

  const Surfaces& surfaces_;
  const Illumination& light_;
  SurfaceLighting lit_;
  std::unique_ptr<const SurfaceLighting> in_mirrors_;  ///< null: nothing mirrors by rays
  PictureAir air_;
  OpenAir open_air_;
  SkyPixel sky_;
};

}  // namespace sunlit::light
