/// How much the air lifts the sun.
#pragma once

#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/site.h"

namespace sunlit::astronomy {

/// The sun's angular radius in SPA: a constant, 0.26667°.
constexpr Angle kSunRadius = Angle::degrees(0.26667);

/// Geometric elevation of the sun's centre when its upper rim touches the horizon: −(radius + refraction at
/// the horizon). The dip of the horizon of a high place is not in it.
inline Angle horizonElevation(const Air& air) {
  return -(kSunRadius + air.refraction_at_horizon);
}

/// Δe, to be added to the geometric (topocentric) elevation; 0 without air. Not below 0, but for the last
/// 0.1° before the zenith: −3e-5° there at the default air.
///
/// From the zenith down to where the sun has set, exactly Reda & Andreas (2008), eq. 42:
///   Δe = P/1010 · 283/(273 + T) · 1.02 / (60 tan(e0 + 10.3/(e0 + 5.11))), angles in degrees.
/// SPA then drops to 0 at once (0.618° at the default air). Here it fades over the next 5°: continued along
/// its tangent and multiplied by 1 − 3x² + 2x³, so that value and slope are continuous at both ends and a
/// lower sun never appears higher. What lies below the horizon is not seen; the fade only keeps light and
/// motion free of jumps. It starts at −1.9° at the lowest, since eq. 42 is meaningless below.
Angle refraction(Angle geometric_elevation, const Air& air);

}  // namespace sunlit::astronomy
