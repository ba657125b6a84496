/// The standard overcast sky.
#pragma once

#include <Eigen/Core>

#include "sunlit/sky/daylight.h"

namespace sunlit::sky {

struct SkyTable;

/// What the standard sky needs to know of the lamps above it.
struct CieLevels {
  struct Lamp {
    float strength;  ///< above the air, relative to the sun at 1 AU
    float sine;      ///< of its elevation without refraction, which rules how bright the sky is
  };
  Lamp sun{1.0F, 1.0F}, moon{0.0F, -1.0F};
  /// Of level ground by the clear sky, without the disc, with the sun's middle on the horizon, lx.
  float clear_at_horizon_lx = 1.0F;
};

/// How a sky of CIE S 011/E:2003 changes with elevation, eq. 1 and 2; type 1's unless told otherwise.
struct Gradation {
  double a = 4.0, b = -0.7;

  /// Luminance at an elevation of sine `z` ≥ 0, relative to the zenith.
  double ofZenith(double z) const;
};

/// Illuminance of level ground under an overcast sky by a sun of so much elevation ≥ 0 at 1 AU, lx: π · 7/9
/// of Radiance's gensky zenith luminance, 8,600 sin h + 123 cd/m².
float cieIlluminance_lx(float sine_of_elevation);

/// CIE S 011/E:2003 type 1, the same all round. As bright as cieIlluminance_lx() says,
/// of the colour of the clear hour; below the horizon, of the clear sky's light sun and moon keep the share
/// that they had there.
class CieSky {
 public:
  CieSky(const SkyTable& clear, const CieLevels& levels);

  /// cd/m² at an elevation of sine `z`; of the horizon below it.
  Eigen::Array3f luminance(float z) const;

 private:
  Eigen::Array3f zenith_;
};

}  // namespace sunlit::sky
