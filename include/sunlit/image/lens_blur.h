/// How sharp a lens is.
#pragma once

#include <vector>

#include "sunlit/image/images.h"
#include "sunlit/quantity/field.h"

namespace sunlit::image {

/// The default is a lens without blur: pixels are the mean of the light on their square.
struct BlurOptions {
  double sigma_px = 0.0;

  bool none() const { return sigma_px == 0.0; }
};

inline std::vector<Field> fieldsOf(BlurOptions& options) {
  return {
      {"sigma",
       &options.sigma_px,
       "px",
       {0, 10},
       "standard deviation of what the lens, and a low-pass filter, make of a point; 0.3 to 0.7 are usual"}};
}

/// Throws std::invalid_argument naming key, value and range.
void validate(const BlurOptions& options);

/// Blurs `picture` by a Gaussian. The sum of all pixels stays, since what leaves the picture comes in again
/// at the same edge. NaN counts as black. The same bits for any thread count.
void blur(const BlurOptions& options, LinearImage* picture);

}  // namespace sunlit::image
