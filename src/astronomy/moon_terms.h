/// The periodic terms of the moon: J. Meeus, Astronomical Algorithms, 2nd edition, 1998, tables 47.A
/// and 47.B.
#pragma once

#include <array>

namespace sunlit::astronomy {

/// A row of table 47.A.
struct MoonTerm {
  std::array<int, 4> multiples;  ///< of D, M, M′, F
  double longitude_udeg;         ///< of the sine, 1e-6 deg
  double distance_m;             ///< of the cosine
};

/// A row of table 47.B.
struct MoonLatitudeTerm {
  std::array<int, 4> multiples;  ///< of D, M, M′, F
  double latitude_udeg;          ///< of the sine, 1e-6 deg
};

extern const std::array<MoonTerm, 60> kMoonTerms;
extern const std::array<MoonLatitudeTerm, 60> kMoonLatitudeTerms;

}  // namespace sunlit::astronomy
