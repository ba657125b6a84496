#include "astronomy/earth_orbit.h"

#include <array>

#include "astronomy/cosines.h"
#include "astronomy/degrees.h"
#include "astronomy/earth_periodic_terms.h"

namespace sunlit::astronomy {
namespace {

constexpr int kMaxTerms = 256;  // of one quantity: L has 129

/// Eq. 9 to 11: Σ_p jme^p Σ_i A cos(B + C·jme), in rad or au.
template <std::size_t n>
double evaluate(const std::array<PeriodicSeries, n>& powers, double jme) {
  std::array<double, kMaxTerms> cosine;
  int count = 0;
  for (const PeriodicSeries& series : powers) {
    for (int i = 0; i < series.count; ++i) cosine[count++] = series.terms[i].b + series.terms[i].c * jme;
  }
  cosines(cosine.data(), count);

  double sum = 0.0;
  for (auto series = powers.rbegin(); series != powers.rend(); ++series) {
    double of_power = 0.0;
    // From the last, smallest term to the first.
    for (int i = series->count - 1; i >= 0; --i) of_power += series->terms[i].a * cosine[--count];
    sum = sum * jme + of_power;
  }
  return sum * 1e-8;
}

}  // namespace

EarthOrbit earthOrbit(double jme) {
  return {inTurn(evaluate(kLongitudeSeries, jme) / kRadPerDeg), evaluate(kLatitudeSeries, jme) / kRadPerDeg,
          evaluate(kDistanceSeries, jme)};
}

}  // namespace sunlit::astronomy
