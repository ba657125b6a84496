/// Periodic terms of the Earth's heliocentric position: Reda & Andreas (2008), NREL/TP-560-34302, Table A4.2
/// (VSOP87 of Bretagnon & Francou 1988, cut to what 0.0003° needs).
#pragma once

#include <array>

namespace sunlit::astronomy {

/// One term A cos(B + C·JME); A in 1e-8 rad (longitude, latitude) or 1e-8 au (distance).
struct PeriodicTerm {
  double a, b, c;
};

/// The terms of one power of JME.
struct PeriodicSeries {
  const PeriodicTerm* terms;
  int count;
};

extern const std::array<PeriodicSeries, 6> kLongitudeSeries;  ///< L0 … L5
extern const std::array<PeriodicSeries, 2> kLatitudeSeries;   ///< B0, B1
extern const std::array<PeriodicSeries, 5> kDistanceSeries;   ///< R0 … R4

}  // namespace sunlit::astronomy
