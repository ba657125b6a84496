#include "stars.h"

#include <algorithm>
#include <cmath>

#include "sunlit/quantity/angle.h"

namespace sunlit::sky {
namespace {

/// Refraction of a direction of true elevation `deg` ≥ −1, at 10 °C and 1010 hPa, rad: Sæmundsson 1986
/// (Meeus, Astronomical Algorithms, eq. 16.4); 0.1′.
double refraction(double deg) {
  return 1.02 / 60.0 * kRadPerDeg / std::tan((deg + 10.3 / (deg + 5.11)) * kRadPerDeg);
}

/// `towards` raised by refraction.
Eigen::Vector3f raised(const Eigen::Vector3d& towards) {
  const double elevation = std::asin(std::clamp(towards.z(), -1.0, 1.0));
  const double seen = std::min(elevation + std::max(0.0, refraction(elevation / kRadPerDeg)), 0.5 * kPi);
  const double across = std::hypot(towards.x(), towards.y());
  const double scale = across > 0.0 ? std::cos(seen) / across : 0.0;
  return Eigen::Vector3d(towards.x() * scale, towards.y() * scale, std::sin(seen)).cast<float>();
}

/// Effective temperature of B − V: Ballesteros 2012, eq. 14.
double temperature(double b_minus_v) {
  return 4600.0 * (1.0 / (0.92 * b_minus_v + 1.7) + 1.0 / (0.92 * b_minus_v + 0.62));
}

}  // namespace

LinearRgb starIlluminance(double v, double b_minus_v) {
  const auto lux = static_cast<float>(kZeroMagnitude_lx * std::pow(10.0, -0.4 * v));
  if (std::isnan(b_minus_v)) {
    return LinearRgb(lux, lux, lux);
  }
  const Spectrum light = blackBody(temperature(std::clamp(b_minus_v, -0.4, 2.0)));
  return inGamut(colourOf(light * static_cast<float>(lux / kLuminousSolarConstant_lx)));
}

std::vector<PointLight> starsAbove(const NightSky& night, const Extinction& extinction) {
  std::vector<PointLight> seen;
  if (!night.stars || !night.map_from_celestial) {
    return seen;
  }
  // Refraction at the horizon raises by 0.57°.
  constexpr double kLowest = -0.0105;
  for (const Star& star : *night.stars) {
    const Eigen::Vector3d towards = (*night.map_from_celestial * star.towards.cast<double>()).normalized();
    if (towards.z() < kLowest) {
      continue;
    }
    const Eigen::Vector3f apparent = raised(towards);
    if (apparent.z() > 0.0F) {
      const Eigen::Array3f passed = extinction.colour(elevationAboveHorizon(apparent));
      seen.push_back({apparent, star.illuminance * LinearRgb(passed)});
    }
  }
  std::stable_sort(seen.begin(), seen.end(), [](const PointLight& a, const PointLight& b) {
    return a.illuminance.luminance() > b.illuminance.luminance();
  });
  return seen;
}

}  // namespace sunlit::sky
