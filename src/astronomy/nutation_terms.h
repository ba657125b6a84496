/// Periodic terms of the nutation: Reda & Andreas (2008), NREL/TP-560-34302, Table A4.3 (IAU 1980 theory, the
/// 63 terms that Meeus, Astronomical Algorithms, Table 22.A lists).
#pragma once

#include <array>

namespace sunlit::astronomy {

/// Argument: Σ y[j]·Xj. Longitude: (a + b·JCE) sin, obliquity: (c + d·JCE) cos; in 0.0001″.
struct NutationTerm {
  std::array<signed char, 5> y;
  double a, b, c, d;
};

extern const std::array<NutationTerm, 63> kNutationTerms;

}  // namespace sunlit::astronomy
