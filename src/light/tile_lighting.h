/// Lights one tile of the picture.
#pragma once

#include <vector>

#include "light/ambient.h"
#include "light/disc/disc_visibility.h"
#include "light/lamps/lamp_light.h"
#include "light/light_table.h"
#include "light/sky_in_view/open_air.h"
#include "light/sky_in_view/picture_air.h"
#include "light/sky_in_view/sky_pixel.h"
#include "sunlit/image/images.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

class TileLighting {
 public:
  /// What is lit, and what stands in the way.
  struct Subject {
    const Surfaces& surfaces;
    const LightTable& table;  ///< of `surfaces`
    const scene::Scene& scene;
    const Visibility& visibility;
  };
  /// Keeps references. Casts the rays to sun and moon, in parallel.
  TileLighting(const Subject& subject, const Illumination& light);

  /// Writes the pixels of `tile`, and no others.
  void light(const Tile& tile, image::LinearImage* image) const;

 private:
  void addSurfaces(const Tile& tile, image::LinearImage* image) const;
  /// What is known of a surface before it is lit.
  struct SurfaceParts {
    const AmbientReflectance& ambient;
    const Mirrored& mirrored;     ///< where the light is baked
    const GatheredSky* gathered;  ///< null: FinalGather did not look there
    float sun, moon;              ///< shares of their discs that it sees
    const Eigen::Array3f* lamps;  ///< its luminance by lamps; null: there are none
    sky::AirColumn before;        ///< between it and the camera
  };
  /// As the camera sees it, cd/m².
  Eigen::Array3f luminance(const Surface& surface, const SurfaceParts& parts) const;

  const Surfaces& surfaces_;
  const LightTable& table_;
  const scene::Scene& scene_;
  const Illumination& light_;
  std::vector<bool> glows_;  ///< of each material
  DiscVisibility sun_, moon_;
  LampLight lamps_;
  PictureAir air_;
  OpenAir open_air_;
  SkyPixel sky_;
};

}  // namespace sunlit::light
