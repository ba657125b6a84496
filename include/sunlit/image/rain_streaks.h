/// Drops of rain that fall through a picture while it is exposed.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <string>

#include "sunlit/image/images.h"
#include "sunlit/image/lens.h"
#include "sunlit/quantity/motion.h"

namespace sunlit::image {

struct RainStreaks {
  double mm_per_h = 0.0;  ///< ≥ 0
  std::uint64_t seed = 0;
  /// Another one, other drops. Cameras that share a moment see the same, and so do conditions: their pictures
  /// of one pose differ by light, not by chance.
  std::int64_t moment = 0;
  double exposure_s = 0.001;
  /// What a drop shows, cd/m²: it gathers light from nearly all that is before it.
  Eigen::Array3f luminance = Eigen::Array3f::Zero();
  Eigen::Vector2d wind_m_s = Eigen::Vector2d::Zero();  ///< x and y in `map`; drops go with it
  std::string drive = {};  ///< that the moment is of: PictureName::drive; in another one fall other drops
};

/// What a camera looks at, from where, and how it moves.
struct RainedView {
  const Lens& lens;
  const Eigen::Isometry3d& map_from_optical;
  const Motion& motion;
  const DepthImage& depth;  ///< m along the axis, or from the camera if lens.wide()
  /// Whether rain gets to a place in `map`; empty: everywhere.
  std::function<bool(const Eigen::Vector3d&)> open = {};
};

/// What drops show before the camera that sees `picture` (cd/m²), where level ground has `illuminance_lx`:
/// half of what is before it, in the mean of all pixels, and half of what is above. No pixel counts more than
/// a level surface could shine back to the one side, or than what lamps light: of the sun's disc and its
/// mirror images drops have their share from above, which does not hang on how small a part of the sky is
/// seen.
Eigen::Array3f dropLuminance(const LinearImage& picture, const Eigen::Array3f& illuminance_lx);

/// Drops of one moment, apart from those of others, each at its place in `map`. Diameters are distributed as
/// Marshall & Palmer (1948) found, N(D) = 8000 e^(−4.1 R^−0.21 D) per m³ and mm; each falls by 9.65 − 10.3
/// e^(−0.6 D) m/s (Atlas, Srivastava & Sekhon 1973), R in mm/h, D in mm, straight down in `map` or slanted by
/// the wind, past a camera that moves. Of 1 mm up, and from 0.1 to 5 m away, they are drawn one by one, and
/// each takes away and sends light as its shadow does in the mean over the exposure; the rest is the air's.
/// Depends on the arguments alone.
void addRain(const RainStreaks& rain, const RainedView& view, LinearImage* picture);

}  // namespace sunlit::image
