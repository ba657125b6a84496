#include "moonlight.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

#include "sunlit/quantity/moon.h"
#include "sunlit/quantity/range.h"
#include "sunlit/sky/eclipse.h"

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

/// Sunlight in the umbra, as bright as the sun: it has passed the air twice, as low as some 5 km above the
/// ground, where it is bent far enough. Ozone, which makes the rim of the umbra blue, is left out.
Spectrum umbraColour() {
  constexpr double kAirMass = 2.0 * 38.0 * 0.54;  // of the horizon (Kasten & Young 1989), and exp(−5 / 8)
  const Spectrum passed = (rayleighOpticalDepth() * static_cast<float>(-kAirMass)).exp();
  return passed * (colourOf(Spectrum::Ones()).luminance() / colourOf(passed).luminance());
}

}  // namespace

void validate(const MoonInSky& moon) {
  require("moon distance", moon.distance_m, {3.4e8, 4.2e8}, "m");
  require("moon phase_angle", moon.phase_angle.deg(), {0.0, 180.0}, "deg");
}

Spectrum moonStrength(const MoonInSky& moon, const SunInSky& sun) {
  const double alpha = moon.phase_angle.deg();
  const double magnitude = -12.73 + 0.026 * alpha + 4e-9 * std::pow(alpha, 4);
  const double t = std::clamp((180.0 - alpha) / 30.0, 0.0, 1.0);
  const double fade = t * t * (3.0 - 2.0 * t);
  const double nearness = kMeanMoonDistance_m / (moon.distance_m * sun.distance_au);
  const double lux = kZeroMagnitude_lx * std::pow(10.0, -0.4 * magnitude) * fade * nearness * nearness;
  static const Spectrum colour = albedoColour();
  const Spectrum strength = colour * static_cast<float>(lux / kLuminousSolarConstant_lx);
  const double straight = sunlightOnMoon(sun, moon);
  if (straight >= 1.0) return strength;
  static const Spectrum bent = umbraColour() * static_cast<float>(kMoonInUmbra);
  return strength * (static_cast<float>(straight) + static_cast<float>(1.0 - straight) * bent);
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
