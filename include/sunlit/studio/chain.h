/// From the light before a lens to the numbers of a picture.
#pragma once

#include <vector>

#include "sunlit/image/exposure.h"
#include "sunlit/image/lens_blur.h"
#include "sunlit/image/mosaic.h"
#include "sunlit/image/sensor_noise.h"
#include "sunlit/image/shutter.h"
#include "sunlit/image/veiling_glare.h"
#include "sunlit/image/vignetting.h"
#include "sunlit/quantity/field.h"

namespace sunlit::studio {

/// In the order in which light passes them. The default is an ideal camera with automatic exposure.
struct ChainOptions {
  image::ShutterOptions shutter;
  image::VignettingOptions vignetting;
  image::GlareOptions glare;
  image::BlurOptions blur;
  image::ExposureOptions exposure;
  image::NoiseOptions noise;
  image::MosaicOptions mosaic;
};

/// One group of rows for each: shutter/line_delay …
std::vector<Field> fieldsOf(ChainOptions& chain);

/// Throws std::invalid_argument naming key, value and range.
void validate(const ChainOptions& chain);

}  // namespace sunlit::studio
