/// The picture as seen through the wings that a lens scatters around each point.
#pragma once

#include <Eigen/Core>

#include "sunlit/image/images.h"

namespace sunlit::image {

/// The mean of `picture`, of finite values, blurred by up to six Gaussians, each twice as wide as the one
/// before; the widest has a standard deviation of an eighth to a quarter of the longer side. The sum of all
/// pixels stays, within rounding. The same bits for any thread count.
LinearImage glareWings(const LinearImage& picture);

/// A light whose image lies beyond the picture.
struct WingsFromBeyond {
  Eigen::Vector2d edge;  ///< px, where the picture is nearest to it
  double away_px;        ///< from there
  Eigen::Array3f light;  ///< cd/m² times pixels
};
/// Adds to `wings` what glareWings() makes of a light in that pixel of the edge, each Gaussian by what of it
/// reaches there. Returns the share of the light that is not among these.
double addWings(const WingsFromBeyond& from, LinearImage* wings);

}  // namespace sunlit::image
