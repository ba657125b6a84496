/// The sky with sun, moon and stars as a camera's pixels see it.
#pragma once

#include <Eigen/Core>

#include "light/disc_in_view.h"
#include "light/star_field.h"
#include "sunlit/image/images.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

class SkyPixel {
 public:
  /// Keeps references.
  SkyPixel(const Surfaces& surfaces, const sky::Daylight& day);

  /// Mean over pixel (x, y) of the sky with sun and moon, cd/m²; without the stars.
  Eigen::Array3f luminance(int x, int y) const;
  /// Adds to the pixels of `tile` what their samples see of the sky, stars included.
  void addTo(const Tile& tile, image::LinearImage* image) const;

 private:
  float skyShare(const Tile& tile, int x, int y) const;

  const Surfaces& surfaces_;
  const sky::Daylight& daylight_;
  DiscInView sun_, moon_;
  StarField stars_;
};

}  // namespace sunlit::light
