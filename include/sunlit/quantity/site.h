/// A place on Earth and the air above it.
#pragma once

#include <vector>

#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/field.h"

namespace sunlit {

/// Where the scene's `map` origin lies.
struct Site {
  Angle latitude;
  Angle longitude;
  double elevation_m = 0.0;
};

inline std::vector<Field> fieldsOf(Site& site) {
  return {{"latitude", &site.latitude, "deg", {-90, 90}, "geodetic, positive north"},
          {"longitude", &site.longitude, "deg", {-180, 180}, "positive east"},
          {"elevation", &site.elevation_m, "m", {-500, 12000}, "above the ellipsoid"}};
}

/// The air as far as it bends light.
struct Air {
  double pressure_hpa = 1013.25;
  double temperature_c = 0.0;
  Angle refraction_at_horizon = Angle::degrees(0.5667);
};

inline std::vector<Field> fieldsOf(Air& air) {
  return {{"pressure", &air.pressure_hpa, "hPa", {0, 1200}, "annual mean at the site; 0: no refraction"},
          {"temperature", &air.temperature_c, "deg C", {-100, 60}, "annual mean at the site"},
          {"atmospheric_refraction", &air.refraction_at_horizon, "deg", {0, 5}, "at sunrise and sunset"}};
}

}  // namespace sunlit
