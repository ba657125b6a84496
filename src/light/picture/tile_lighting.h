/// Lights one tile of the picture.
#pragma once

#include <memory>
#include <vector>

#include "light/picture/fog/lamp_glow.h"
#include "light/picture/mirror/shared_lobes.h"
#include "light/picture/ready_picture.h"
#include "light/picture/sky/open_air.h"
#include "light/picture/sky/picture_air.h"
#include "light/picture/sky/sky_pixel.h"
#include "light/picture/surface_lighting.h"
#include "sunlit/image/images.h"
#include "sunlit/light/illumination.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/light/visibility.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

class TileLighting {
 public:
  /// What stands in the way.
  struct Surroundings {
    const scene::Scene& scene;
    const Visibility& visibility;
  };
  /// Keeps references. Casts the rays to sun and moon and lights what mirrors show, in parallel.
  TileLighting(const ReadyPicture& picture, const Surroundings& in, const Illumination& light);

  /// Writes the pixels of the tile of that number, and no others.
  void light(std::size_t tile, image::LinearImage* image) const;

 private:
  void addSurfaces(std::size_t tile, image::LinearImage* image) const;
  /// What all mirroring surfaces of the picture show by their rays.
  MirroredLuminances allMirrored() const;
  /// One tile of ReadyPicture::mirrors[depth].
  struct TileInMirrors {
    std::size_t number, depth;
  };
  /// What those mirroring surfaces show, each by its own rays; `deeper` is what those of the next depth do.
  void lightMirrored(const TileInMirrors& tile, const std::vector<Eigen::Array3f>& deeper,
                     std::vector<Eigen::Array3f>* luminances) const;
  /// `luminances` are of these.
  std::vector<SurfaceLighting::SeenByRays> seenByRays(std::size_t tile, std::size_t depth,
                                                      const std::vector<Eigen::Array3f>& luminances) const;

  const ReadyPicture& picture_;
  sky::Daylight day_;  ///< seen from the camera
  SurfaceLighting lit_;
  std::vector<std::unique_ptr<const SurfaceLighting>> in_mirrors_;  ///< of each of ReadyPicture::mirrors
  MirroredLuminances mirrored_;                                     ///< of each tile
  PictureAir air_;
  OpenAir open_air_;
  SkyPixel sky_;
  LampGlow glow_;
};

}  // namespace sunlit::light
