/// A sensor that sees one colour in each pixel.
#pragma once

#include <vector>

#include "sunlit/image/images.h"
#include "sunlit/quantity/field.h"

namespace sunlit::image {

/// Colours of the first two pixels of the first row and of the second (Bayer 1976).
enum class MosaicPattern { kNone, kRggb, kBggr, kGrbg, kGbrg };
enum class Demosaic { kBilinear, kVng, kEdgeAware };

/// The default is a sensor for each colour.
struct MosaicOptions {
  MosaicPattern pattern = MosaicPattern::kNone;
  Demosaic demosaic = Demosaic::kBilinear;
};

inline std::vector<Field> fieldsOf(MosaicOptions& options) {
  return {{"pattern",
           choiceOf(&options.pattern, {"none", "rggb", "bggr", "grbg", "gbrg"}),
           "",
           {},
           "colours of the first two rows of a sensor that sees one in each pixel; none: all three"},
          {"demosaic",
           choiceOf(&options.demosaic, {"bilinear", "vng", "edge_aware"}),
           "",
           {},
           "how OpenCV finds the other two: bilinear, by variable gradients, or along edges"}};
}

/// Keeps of each pixel of `picture` the colour that its sensor sees, and has the other two found again from
/// those around (OpenCV's demosaicing, of 8 bits, as image_proc does with a camera that sends bayer_rggb8,
/// its display curve on). A picture of one grey stays as it is. At least 8 × 8 px; without a pattern
/// unchanged. The same bits for any thread count.
Rgb8Image throughMosaic(Rgb8Image picture, const MosaicOptions& options);

}  // namespace sunlit::image
