#include "sight_path.h"

#include <cmath>

#include "heights.h"

namespace sunlit::sky {

SightPath sightPath(const Medium& medium, const Sunlight& sunlight, const SightStart& start,
                    const std::vector<double>& edges_km) {
  SightPath path;
  path.cos_zenith = start.cos_zenith;
  path.sin_zenith = std::sqrt(std::max(0.0, 1.0 - start.cos_zenith * start.cos_zenith));
  path.hits_ground = hitsGround(medium, start.altitude_km, start.cos_zenith);
  float aerosol_km = 0.0F;
  path.steps.reserve(edges_km.size());
  path.end = followRay(medium, start, edges_km, [&](const RayPoint& point, double step_km) {
    const LocalMedium local = medium.at(point.altitude_km);
    const auto length_km = static_cast<float>(step_km);
    const Spectrum depth = (local.scaled_extinction * length_km).max(1e-12F);
    const Spectrum passed = (-depth).exp();
    const Spectrum weight = path.transmittance * ((1.0F - passed) / depth) * length_km;
    const float step_aerosol_km = medium.aerosolDensity(point.altitude_km) * length_km;
    const double z = point.direction.dot(point.up);
    path.steps.push_back({local.rayleigh_scattering * weight, local.aerosol_scattering * weight, point,
                          aerosol_km + 0.5F * step_aerosol_km, heightRoot(point.altitude_km), z,
                          std::sqrt(std::max(0.0, 1.0 - z * z)), sunlight.heightAt(point.altitude_km)});
    path.transmittance *= passed;
    aerosol_km += step_aerosol_km;
  });
  return path;
}

}  // namespace sunlit::sky
