/// The sun as seen from the centre of the Earth: what depends on time alone.
#pragma once

#include <optional>
#include <vector>

#include "sunlit/quantity/angle.h"
#include "sunlit/quantity/field.h"
#include "sunlit/quantity/instant.h"

namespace sunlit::astronomy {

/// How the Earth's rotation differs from the clocks.
struct EarthRotation {
  double delta_ut1_s = 0.0;
  std::optional<double> delta_t_s;  ///< without a value: deltaT() of the instant
};

inline std::vector<Field> fieldsOf(EarthRotation& earth) {
  return {{"delta_ut1", &earth.delta_ut1_s, "s", {-1, 1}, "UT1 - UTC; 0.9 s move the sun by 0.004 deg"},
          // The published polynomials reach 56,000 s at the ends of the supported years.
          {"delta_t",
           NumberOrWord{&earth.delta_t_s, "auto"},
           "s",
           {-100000, 100000},
           "TT - UT1; auto: the polynomials of Espenak and Meeus; 1 s moves the moon by 0.5 arcsec"}};
}

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
