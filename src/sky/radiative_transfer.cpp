#include "radiative_transfer.h"

#include <cmath>

namespace sunlit::sky {
namespace {

constexpr int kSightSteps = 48;
constexpr int kTransmittanceSteps = 160;

}  // namespace

Spectrum RadiativeTransfer::transmittance(double altitude_km, double cos_zenith) const {
  if (hitsGround(medium_, altitude_km, cos_zenith)) {
    return Spectrum::Zero();
  }
  Spectrum depth = Spectrum::Zero();
  followRay(medium_, {altitude_km, cos_zenith},
            sightEdges(medium_, altitude_km, cos_zenith, kTransmittanceSteps),
            [&](const RayPoint& point, double step_km) {
              depth += medium_.at(point.altitude_km).extinction * static_cast<float>(step_km);
            });
  return (-depth).exp();
}

SightPath RadiativeTransfer::sightFrom(double altitude_km, double cos_zenith) const {
  return sightPath(medium_, sunlight_, {altitude_km, cos_zenith},
                   sightEdges(medium_, altitude_km, cos_zenith, kSightSteps));
}

// Aerosol scatters so far ahead that light which it scattered often still comes from near the sun. Of what it
// scatters, the scaled medium lets a part g pass. Along a path on which that part has the optical depth x, it
// meets no such scattering with probability e^−x, and n of them with xⁿ e^−x / n!. So light scattered once is
// dimmed by e^−x more than the scaled medium says, and the rest of what passed, 1 − e^−x − x e^−x in all, was
// scattered twice or more.
void RadiativeTransfer::addStep(const SightStep& step, const SunAlong& sun, double sun_cos_angle,
                                Scattered* sum) const {
  const auto cosine = static_cast<float>(sun_cos_angle);
  sum->smooth += diffuse_.towardsEye(step, sun);
  const Beam beam = sunlight_.at(step.sunlight, sun.cosineTo(step.middle.up));
  if (beam.scaled[kBands - 1] <= 0.0F) {
    return;
  }
  // Below 1e-4 the quotient loses its digits.
  const Spectrum x = (medium_.forwardAtSeaLevel() * (step.aerosol_km + beam.aerosol_km)).max(1e-4F);
  const Spectrum never = (-x).exp();
  const Spectrum by_aerosol = step.by_aerosol * beam.scaled;
  sum->smooth += step.by_air * beam.scaled * rayleighPhase(cosine) +
                 by_aerosol * (1.0F - never) * aerosolWidePhase(cosine);
  sum->aerosol += by_aerosol * never;
  sum->aerosol_again += by_aerosol * ((1.0F - never) / x - never) * kAerosolForwardPart;
}

Scattered RadiativeTransfer::scattered(const SightPath& path, double sun_cos_zenith,
                                       double sun_cos_angle) const {
  Scattered result;
  const SunAlong sun(path, sun_cos_zenith, sun_cos_angle);
  for (const SightStep& step : path.steps) {
    addStep(step, sun, sun_cos_angle, &result);
  }
  if (path.hits_ground) {
    result.smooth += path.transmittance * diffuse_.ground(sun.cosineTo(path.end.up));
  }
  return result;
}

}  // namespace sunlit::sky
