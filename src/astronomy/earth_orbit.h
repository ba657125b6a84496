/// Where the Earth stands as seen from the sun.
#pragma once

namespace sunlit::astronomy {

/// Heliocentric ecliptic coordinates of the Earth, of date.
struct EarthOrbit {
  double longitude_deg;  ///< L, [0, 360)
  double latitude_deg;   ///< B
  double distance_au;    ///< R
};

/// Reda & Andreas (2008), step 3.2. `jme`: Julian ephemeris millennia since J2000 (TT).
EarthOrbit earthOrbit(double jme);

}  // namespace sunlit::astronomy
