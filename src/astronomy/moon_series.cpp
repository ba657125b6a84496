#include "astronomy/moon_series.h"

#include <array>
#include <cmath>

#include "astronomy/degrees.h"
#include "astronomy/moon_terms.h"

namespace sunlit::astronomy {
namespace {

double quartic(double t, const std::array<double, 5>& c) {
  return inTurn(c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * c[4]))));
}

/// The argument of a term, deg, and its share by the eccentricity of the Earth's orbit, eq. 47.6.
struct Arguments {
  std::array<double, 4> deg;  ///< D, M, M′, F
  double eccentricity;        ///< E

  double of(const std::array<int, 4>& multiples) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < deg.size(); ++i) sum += multiples[i] * deg[i];
    return sum;
  }
  double share(const std::array<int, 4>& multiples) const {
    return std::pow(eccentricity, std::abs(multiples[1]));
  }
};

/// Eq. 47.2 to 47.6.
Arguments argumentsAt(double t) {
  return {{quartic(t, {297.8501921, 445267.1114034, -0.0018819, 1.0 / 545868.0, -1.0 / 113065000.0}),
           quartic(t, {357.5291092, 35999.0502909, -0.0001536, 1.0 / 24490000.0, 0.0}),
           quartic(t, {134.9633964, 477198.8675055, 0.0087414, 1.0 / 69699.0, -1.0 / 14712000.0}),
           quartic(t, {93.2720950, 483202.0175233, -0.0036539, -1.0 / 3526000.0, 1.0 / 863310000.0})},
          1.0 - t * (0.002516 + t * 0.0000074)};
}

}  // namespace

EclipticMoon moonByMeeus(double jce) {
  const double t = jce;
  // Eq. 47.1, which has the light time in it.
  const double mean_longitude =
      quartic(t, {218.3164477, 481267.88123421, -0.0015786, 1.0 / 538841.0, -1.0 / 65194000.0});
  const Arguments arguments = argumentsAt(t);
  const double anomaly = arguments.deg[2];
  const double node_distance = arguments.deg[3];
  const double venus = 119.75 + 131.849 * t;
  const double jupiter = 53.09 + 479264.290 * t;
  const double a3 = 313.45 + 481266.484 * t;

  double longitude =
      3958.0 * sinDeg(venus) + 1962.0 * sinDeg(mean_longitude - node_distance) + 318.0 * sinDeg(jupiter);
  double distance_m = 385000560.0;
  for (const MoonTerm& term : kMoonTerms) {
    const double argument = arguments.of(term.multiples);
    const double share = arguments.share(term.multiples);
    longitude += term.longitude_udeg * share * sinDeg(argument);
    distance_m += term.distance_m * share * cosDeg(argument);
  }
  double latitude = -2235.0 * sinDeg(mean_longitude) + 382.0 * sinDeg(a3) +
                    175.0 * sinDeg(venus - node_distance) + 175.0 * sinDeg(venus + node_distance) +
                    127.0 * sinDeg(mean_longitude - anomaly) - 115.0 * sinDeg(mean_longitude + anomaly);
  for (const MoonLatitudeTerm& term : kMoonLatitudeTerms)
    latitude += term.latitude_udeg * arguments.share(term.multiples) * sinDeg(arguments.of(term.multiples));
  constexpr double kDegPerUdeg = 1e-6;
  return {inTurn(mean_longitude + longitude * kDegPerUdeg), latitude * kDegPerUdeg, distance_m};
}

}  // namespace sunlit::astronomy
