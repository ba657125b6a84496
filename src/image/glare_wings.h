/// The picture as seen through the wings that a lens scatters around each point.
#pragma once

#include "sunlit/image/images.h"

namespace sunlit::image {

/// The mean of `picture`, of finite values, blurred by up to six Gaussians, each twice as wide as the one
/// before; the widest has a standard deviation of an eighth to a quarter of the longer side. The sum of all
/// pixels stays, within rounding. The same bits for any thread count.
LinearImage glareWings(const LinearImage& picture);

}  // namespace sunlit::image
