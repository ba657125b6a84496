#include "sunlit/astronomy/refraction.h"

#include <algorithm>
#include <cmath>

namespace sunlit::astronomy {
namespace {

constexpr double kFadeWidthDeg = 5.0;
/// Where e0 + 10.3/(e0 + 5.11) is smallest: below, eq. 42 shrinks and finally oscillates.
constexpr double kLowestFormulaDeg = -1.9;

double scaleDeg(const Air& air) {
  return air.pressure_hpa / 1010.0 * (283.0 / (273.0 + air.temperature_c)) * 1.02 / 60.0;
}

/// Eq. 42.
double formulaDeg(double elevation_deg, const Air& air) {
  return scaleDeg(air) / std::tan((elevation_deg + 10.3 / (elevation_deg + 5.11)) * kRadPerDeg);
}

/// Its derivative by the elevation, degrees per degree.
double formulaSlope(double elevation_deg, const Air& air) {
  const double shifted = elevation_deg + 5.11;
  const double sine = std::sin((elevation_deg + 10.3 / shifted) * kRadPerDeg);
  return -scaleDeg(air) / (sine * sine) * (1.0 - 10.3 / (shifted * shifted)) * kRadPerDeg;
}

}  // namespace

Angle refraction(Angle geometric_elevation, const Air& air) {
  const double elevation = geometric_elevation.deg();
  const double fade_start = std::max(horizonElevation(air).deg(), kLowestFormulaDeg);
  if (elevation >= fade_start) return Angle::degrees(formulaDeg(elevation, air));

  const double below = fade_start - elevation;
  if (below >= kFadeWidthDeg) return Angle();
  const double along_tangent = formulaDeg(fade_start, air) - formulaSlope(fade_start, air) * below;
  const double x = below / kFadeWidthDeg;
  return Angle::degrees(along_tangent * (1.0 - x * x * (3.0 - 2.0 * x)));
}

}  // namespace sunlit::astronomy
