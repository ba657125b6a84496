/// The sun as seen from the centre of the Earth: what depends on time alone.
#pragma once

#include <optional>

#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/instant.h"

namespace sunlit::astronomy {

/// How the Earth's rotation differs from the clocks.
struct EarthRotation {
  double delta_ut1_s = 0.0;         ///< UT1 − UTC, −1 … 1 s
  std::optional<double> delta_t_s;  ///< TT − UT1; without a value: deltaT() of the instant
};

/// Geocentric, apparent, of date. Costs most of a sun position, and serves every place on Earth at that
/// instant.
struct SolarCoordinates {
  Angle right_ascension;            ///< α, [0°, 360°)
  Angle declination;                ///< δ
  Angle apparent_sidereal_time;     ///< ν, at Greenwich, [0°, 360°)
  Angle apparent_longitude;         ///< λ on the ecliptic, [0°, 360°)
  Angle obliquity;                  ///< ε, true
  double distance_au = 1.0;         ///< R
  double equation_of_time_s = 0.0;  ///< apparent minus mean solar time
};

/// Reda & Andreas, Solar Position Algorithm for Solar Radiation Applications, NREL/TP-560-34302 (revised
/// 2008), steps 3.1 to 3.10 and A.1. Years −2000 to 6000 (not checked here: instantOf() does). Together with
/// the topocentric step within 0.0003° of ERFA over 1900 to 2100; see doc/equations.md for the largest error
/// measured.
SolarCoordinates solarCoordinates(const Instant& instant, const EarthRotation& earth);

}  // namespace sunlit::astronomy
