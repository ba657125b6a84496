/// A place on Earth and the air above it.
#pragma once

#include "sunlit/quantity/angle.h"

namespace sunlit {

/// Where the scene's `map` origin lies.
struct Site {
  Angle latitude;            ///< geodetic, positive north, −90° … 90°
  Angle longitude;           ///< positive east, −180° … 180°
  double elevation_m = 0.0;  ///< above the ellipsoid, −500 … 12000 m
};

/// The air as far as it bends light.
struct Air {
  double pressure_hpa = 1013.25;  ///< annual mean at the site, 0 … 1200 hPa; 0: no refraction
  double temperature_c = 0.0;     ///< annual mean at the site, −100 … 60 °C
  Angle refraction_at_horizon = Angle::degrees(0.5667);  ///< at sunrise and sunset, 0° … 5°
};

}  // namespace sunlit
