/// The moon by J. Meeus, Astronomical Algorithms, 2nd edition, 1998, chapter 47.
#pragma once

namespace sunlit::astronomy {

/// The moon in the mean equinox and ecliptic of date, as seen from the centre of the Earth.
struct EclipticMoon {
  double longitude_deg;  ///< where it stood when the light left it that arrives now
  double latitude_deg;
  double distance_m;
};

/// `jce`: Julian centuries of Terrestrial Time since J2000. Meeus: some 10″ in longitude and 4″ in latitude
/// from the truth. Within 0.1″ and 0.1 km of ERFA's eraMoon98 over 1900 to 2100.
EclipticMoon moonByMeeus(double jce);

}  // namespace sunlit::astronomy
