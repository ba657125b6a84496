/// How far a picture is from the reference.
#pragma once

#include <cstddef>

#include "sunlit/image/images.h"
#include "sunlit/light/reference.h"
#include "sunlit/light/surfaces.h"

namespace sunlit::light {

/// Of |picture − reference| / reference in luminance, a value a pixel, over all pixels in which any sample
/// sees a surface: pure sky is left out, since both show the same. No pixel is dropped for being dark: where
/// the reference is below `floor_cd_per_m2`, a thousandth of its mean over these pixels, that is divided by.
struct LuminanceError {
  std::size_t pixels = 0;
  double mean = 0.0;
  double median = 0.0;
  double p95 = 0.0;    ///< 95th percentile
  double bias = 0.0;   ///< (mean picture − mean reference) / mean reference
  double noise = 0.0;  ///< mean relative error that the reference's own noise would make alone
  double floor_cd_per_m2 = 0.0;
};

/// All zero where no pixel sees a surface, or the reference is black, which no error is relative to. Throws
/// std::invalid_argument for pictures of different sizes.
LuminanceError luminanceError(const image::LinearImage& picture, const Traced& reference,
                              const Surfaces& surfaces);

/// Signed relative error of every pixel, 0 for pure sky: what luminanceError() is the statistics of.
image::Picture<float, 1> relativeErrors(const image::LinearImage& picture, const Traced& reference,
                                        const Surfaces& surfaces);

}  // namespace sunlit::light
