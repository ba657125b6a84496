/// The wobble of the Earth's axis.
#pragma once

#include <array>

namespace sunlit::astronomy {

/// Nutation and the obliquity of the ecliptic.
struct Nutation {
  std::array<double, 5>
      x_deg;             ///< X0 … X4: elongation and anomalies of moon and sun, argument of latitude, node
  double longitude_deg;  ///< Δψ
  double obliquity_deg;  ///< Δε
  double mean_obliquity_arcsec;  ///< ε0
  double true_obliquity_deg;     ///< ε
};

/// Reda & Andreas (2008), steps 3.4 and 3.5. `jce`: Julian ephemeris centuries since J2000 (TT).
Nutation nutation(double jce);

}  // namespace sunlit::astronomy
