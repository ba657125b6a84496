/// What lights the scene beside the sun: moon, stars and the faint glow between them.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "sunlit/quantity/direction.h"
#include "sunlit/quantity/moon.h"
#include "sunlit/quantity/photometry.h"

namespace sunlit::sky {

/// Where the moon stands and how it is lit.
struct MoonInSky {
  Direction apparent;                                 ///< with refraction: where the disc is seen
  std::optional<Direction> geometric = std::nullopt;  ///< without; default: as `apparent`
  double distance_m =
      kMeanMoonDistance_m;  ///< from the observer, 3.4e8 … 4.2e8 m; sets disc size and strength
  Angle phase_angle;        ///< at the moon between sun and observer: 0 full, 180° new
};

/// A star outside the atmosphere.
struct Star {
  Eigen::Vector3f towards;  ///< unit, in the celestial frame: equator and equinox of J2000
  LinearRgb illuminance;    ///< lx on a plane facing it, above the atmosphere
};

/// What the night adds to a Daylight. Without `map_from_celestial` no stars are seen, and the diffuse glow is
/// the mean over the whole sky.
struct NightSky {
  std::optional<MoonInSky> moon;
  std::optional<Eigen::Matrix3d> map_from_celestial;  ///< rotation from J2000 equatorial axes to `map`
  std::shared_ptr<const std::vector<Star>> stars;     ///< null: none
};

/// Illuminance above the atmosphere of a star of visual magnitude `v` and colour index `b_minus_v` (B − V,
/// −0.4 … 2; NaN: white), lx.
LinearRgb starIlluminance(double v, double b_minus_v);

/// A star as it is seen: `towards` in `map`, refracted, dimmed and reddened by the air.
struct PointLight {
  Eigen::Vector3f towards;  ///< unit, in `map`
  LinearRgb illuminance;    ///< lx on a plane facing it, at the ground
};

}  // namespace sunlit::sky
