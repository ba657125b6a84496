#include "cie_sky.h"

#include <algorithm>
#include <cmath>

#include "droplets.h"
#include "hemisphere.h"
#include "quadrature.h"
#include "sky_table.h"
#include "sphere.h"
#include "sunlit/quantity/angle.h"

namespace sunlit::sky {
namespace {

/// Of the night's glow, which comes from all the sky: what the standard sky has of the clear one with the sun
/// at 42°, above and below which lies half of a level plane's sky.
constexpr float kOfGlow = 0.19F;

/// Illuminance of level ground of a zenith of 1 cd/m²: 0.7797 π.
double levelOfZenith() {
  double sum = 0.0;
  for (const Node& node : gaussLegendre(64, 0.0, 1.0))
    sum += 2.0 * kPi * node.weight * node.x * Gradation().ofZenith(node.x);
  return sum;
}

/// What one lamp gives level ground under the clear sky.
struct ClearLight {
  Eigen::Array3f direct, scattered;
};

/// In its colour, as bright as the overcast is.
Eigen::Array3f overcast(const ClearLight& clear, const CieLevels::Lamp& lamp, float at_horizon_share) {
  const Eigen::Array3f both = clear.direct + clear.scattered;
  const float luminance = LinearRgb(both).luminance();
  if (luminance <= 0.0F) return Eigen::Array3f::Zero();
  // The disc is seen below the horizon, too, raised by refraction; what scatters its light knows nothing of
  // that.
  const float level_lx = lamp.sine < 0.0F ? LinearRgb(clear.scattered).luminance() * at_horizon_share
                                          : cieIlluminance_lx(lamp.sine) * lamp.strength;
  return both * (level_lx / luminance);
}

}  // namespace

double Gradation::ofZenith(double z) const {
  const auto phi = [&](double cosine) { return 1.0 + a * std::exp(b / std::max(cosine, 1e-4)); };
  return phi(z) / phi(1.0);
}

float cieIlluminance_lx(float sine_of_elevation) {
  return static_cast<float>(kPi * 7.0 / 9.0) * (8600.0F * sine_of_elevation + 123.0F);
}

CieSky::CieSky(const SkyTable& clear, const CieLevels& levels) {
  const auto pieces = hemisphere(headingOf(clear.sun.towards.vector().cast<float>()));
  const float share = cieIlluminance_lx(0.0F) / levels.clear_at_horizon_lx;
  Eigen::Array3f level = Eigen::Array3f::Zero();
  const auto add = [&](const DiscLight& disc, const auto& scattered, const CieLevels::Lamp& lamp) {
    ClearLight light{onLevelGround(disc), Eigen::Array3f::Zero()};
    if (scattered)
      light.scattered = levelIlluminance(
          pieces, [&](const Eigen::Vector3f& towards) { return scattered->luminance(towards); });
    level += overcast(light, lamp, share);
  };
  add(clear.sun, clear.sun_sky, levels.sun);
  add(clear.moon, clear.moon_sky, levels.moon);
  if (clear.glow) {
    level += kOfGlow * levelIlluminance(pieces, [&](const Eigen::Vector3f& towards) {
               return clear.glow->luminance(towards);
             });
  }
  static const auto kLevel = static_cast<float>(levelOfZenith());
  zenith_ = level * kOvercastBluing / kLevel;
}

Eigen::Array3f CieSky::luminance(float z) const {
  return zenith_ * static_cast<float>(Gradation().ofZenith(std::max(0.0, static_cast<double>(z))));
}

}  // namespace sunlit::sky
