/// Every step of SPA's geocentric part, under the names of its report.
#pragma once

#include "astronomy/earth_orbit.h"
#include "astronomy/nutation.h"
#include "sunlit/astronomy/solar_coordinates.h"

namespace sunlit::astronomy {

/// The time arguments of step 3.1.
struct JulianTimes {
  double jd_since_2000;  ///< UT1 days since 2451545.0, kept apart to lose no digits
  double day_fraction;   ///< of jd_since_2000, [0, 1)
  double jce;            ///< Julian ephemeris century
  double jme;            ///< Julian ephemeris millennium

  double jd() const { return 2451545.0 + jd_since_2000; }
  double jde() const { return 2451545.0 + jce * 36525.0; }
};

JulianTimes julianTimes(const Instant& instant, const EarthRotation& earth);

/// Angles in degrees. Steps 3.2 to 3.10 and A.1 of Reda & Andreas (2008).
struct GeocentricSun {
  JulianTimes times;
  EarthOrbit earth;
  Nutation nutation;
  double theta;    ///< Θ geocentric longitude
  double beta;     ///< β geocentric latitude
  double dtau;     ///< Δτ aberration
  double lambda;   ///< λ apparent longitude
  double nu0;      ///< ν0 mean sidereal time at Greenwich
  double nu;       ///< ν apparent sidereal time at Greenwich
  double alpha;    ///< α right ascension
  double delta;    ///< δ declination
  double m;        ///< M mean longitude of the sun
  double eot_min;  ///< E equation of time, min
};

GeocentricSun geocentricSun(const Instant& instant, const EarthRotation& earth);

}  // namespace sunlit::astronomy
