/// Drops of rain that fall through a picture while it is exposed.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "sunlit/image/camera.h"
#include "sunlit/image/images.h"

namespace sunlit::image {

struct RainStreaks {
  double mm_per_h = 0.0;     ///< ≥ 0
  std::uint64_t series = 0;  ///< another one, other drops; so does another `index`
  std::int64_t index = 0;    ///< of the picture
  double exposure_s = 0.001;
  /// What a drop shows, cd/m²: it gathers light from nearly all that is before it.
  Eigen::Array3f luminance = Eigen::Array3f::Zero();
};

/// What the camera looks at, and where down is in its optical frame (unit).
struct RainedView {
  const PinholeCamera& camera;
  const Eigen::Vector3d& down;
  const DepthImage& depth;
};

/// Drops of one picture, apart from those of others. Diameters are distributed as Marshall & Palmer (1948)
/// found, N(D) = 8000 e^(−4.1 R^−0.21 D) per m³ and mm; each falls by 9.65 − 10.3 e^(−0.6 D) m/s (Atlas,
/// Srivastava & Sekhon 1973), R in mm/h, D in mm. Of 1 mm up, and as far as 5 m, they are drawn one by one,
/// and each takes away and sends light as its shadow does in the mean over the exposure; the rest is the
/// air's. Of a lens that bends, where they are is by its pinhole. The camera's own motion is not in it.
/// Depends on the arguments alone.
void addRain(const RainStreaks& rain, const RainedView& view, LinearImage* picture);

}  // namespace sunlit::image
