/// How bright a picture is as a whole.
#pragma once

#include <Eigen/Core>

#include "sunlit/image/images.h"

namespace sunlit::image {

/// Of all pixels, cd/m² by channel. NaN counts as black. By rows, so that it does not depend on who sums up.
Eigen::Array3d meanLuminance(const LinearImage& picture);

}  // namespace sunlit::image
