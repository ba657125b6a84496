/// TT − UT1 from published polynomials.
#pragma once

#include "sunlit/quantity/instant.h"

namespace sunlit::astronomy {

/// ΔT = TT − UT1 in s: the polynomial expressions of Espenak & Meeus, Five Millennium Canon of Solar Eclipses
/// (2006), NASA/TP-2006-214141, for −1999 to 3000; their outermost parabola is used up to the years −2000 and
/// 6000.
///
/// Within 1 s of observation from 1900 to 2005. Later years are a forecast made in 2005: 5 s too large by
/// 2024, which moves the sun by 7e-5°. The pieces join within 0.3 s.
double deltaT(const Instant& instant);

}  // namespace sunlit::astronomy
