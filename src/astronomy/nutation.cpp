#include "astronomy/nutation.h"

#include <array>
#include <tuple>

#include "astronomy/cosines.h"
#include "astronomy/nutation_terms.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::astronomy {
namespace {

double cubic(double t, const std::array<double, 4>& c) {
  return c[0] + t * (c[1] + t * (c[2] + t * c[3]));
}

/// ε0 in arcseconds, eq. 24. `u`: 10,000 Julian years since J2000.
double meanObliquity(double u) {
  constexpr std::array<double, 11> kCoefficients = {84381.448, -4680.93, -1.55, 1999.25, -51.38, -249.67,
                                                    -39.05,    7.12,     27.87, 5.79,    2.45};
  double sum = 0.0;
  for (auto c = kCoefficients.rbegin(); c != kCoefficients.rend(); ++c) sum = sum * u + *c;
  return sum;
}

}  // namespace

Nutation nutation(double jce) {
  Nutation result;
  // Eq. 15 to 19.
  result.x_deg = {cubic(jce, {297.85036, 445267.111480, -0.0019142, 1.0 / 189474.0}),
                  cubic(jce, {357.52772, 35999.050340, -0.0001603, -1.0 / 300000.0}),
                  cubic(jce, {134.96298, 477198.867398, 0.0086972, 1.0 / 56250.0}),
                  cubic(jce, {93.27191, 483202.017538, -0.0036825, 1.0 / 327270.0}),
                  cubic(jce, {125.04452, -1934.136261, 0.0020708, 1.0 / 450000.0})};
  constexpr int kCount = static_cast<int>(std::tuple_size<decltype(kNutationTerms)>::value);
  std::array<double, 2 * kCount> cosine;  // of the arguments, then of the arguments less 90°: their sines
  for (int i = 0; i < kCount; ++i) {
    double argument = 0.0;
    for (std::size_t j = 0; j < 5; ++j) argument += kNutationTerms[i].y[j] * result.x_deg[j];
    cosine[i] = argument * kRadPerDeg;
    cosine[kCount + i] = argument * kRadPerDeg - kPi / 2.0;
  }
  cosines(cosine.data(), 2 * kCount);
  double longitude = 0.0;
  double obliquity = 0.0;
  for (int i = kCount - 1; i >= 0; --i) {
    const NutationTerm& term = kNutationTerms[i];
    longitude += (term.a + term.b * jce) * cosine[kCount + i];
    obliquity += (term.c + term.d * jce) * cosine[i];
  }
  result.longitude_deg = longitude / 36e6;
  result.obliquity_deg = obliquity / 36e6;
  result.mean_obliquity_arcsec = meanObliquity(jce / 100.0);
  result.true_obliquity_deg = result.mean_obliquity_arcsec / 3600.0 + result.obliquity_deg;
  return result;
}

}  // namespace sunlit::astronomy
