#include "moonlight.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "sunlit/quantity/moon.h"
#include "sunlit/quantity/range.h"

namespace sunlit::sky {
namespace {

constexpr double kRedness = 1.1;

/// Albedo by band, scaled so that sunlight of one lux gives one lux.
Spectrum albedoColour() {
  Spectrum albedo;
  for (int band = 0; band < kBands; ++band) {
    albedo[band] = static_cast<float>(std::pow(bandCentre_nm(band) / 550.0, kRedness));
  }
  return albedo * (colourOf(Spectrum::Ones()).luminance() / colourOf(albedo).luminance());
}

}  // namespace

void validate(const MoonInSky& moon) {
  require("moon distance", moon.distance_m, {3.4e8, 4.2e8}, "m");
  require("moon phase_angle", moon.phase_angle.deg(), {0.0, 180.0}, "deg");
}

Spectrum moonStrength(const MoonInSky& moon, double sun_distance_au) {
  const double alpha = moon.phase_angle.deg();
  const double magnitude = -12.73 + 0.026 * alpha + 4e-9 * std::pow(alpha, 4);
  const double t = std::clamp((180.0 - alpha) / 30.0, 0.0, 1.0);
  const double fade = t * t * (3.0 - 2.0 * t);
  const double nearness = kMeanMoonDistance_m / (moon.distance_m * sun_distance_au);
  const double lux = kZeroMagnitude_lx * std::pow(10.0, -0.4 * magnitude) * fade * nearness * nearness;
  static const Spectrum colour = albedoColour();
  return colour * static_cast<float>(lux / kLuminousSolarConstant_lx);
}

Angle moonAngularRadius(const MoonInSky& moon) {
  return Angle::radians(std::asin(kMoonRadius_m / moon.distance_m));
}

Direction moonLitFrom(const MoonInSky& moon, const Direction& sun) {
  const Eigen::Vector3d to_observer = -moon.apparent.vector();
  const Eigen::Vector3d aside = sun.vector() - sun.vector().dot(to_observer) * to_observer;
  // A sun straight behind or before the moon lights it evenly all round.
  const Eigen::Vector3d across =
      aside.norm() > 1e-9 ? Eigen::Vector3d(aside.normalized()) : to_observer.unitOrthogonal();
  return Direction(to_observer * cos(moon.phase_angle) + across * sin(moon.phase_angle));
}

}  // namespace sunlit::sky
