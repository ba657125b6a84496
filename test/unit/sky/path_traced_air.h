/// The slow oracle: one light path after another through the real medium, with the real phase functions at
/// every scattering, traced backwards from the eye. No table, no similarity relation, no steps.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "sky/radiative_transfer.h"
#include "sky/ray_path.h"
#include "sunlit/quantity/angle.h"
#include "traced_paths.h"

namespace sunlit::sky {

class PathTracedAir : public TracedPaths {
 public:
  /// `transfer` lends its medium and its exact transmittance() to the sun, not its scattering tables.
  PathTracedAir(const RadiativeTransfer& transfer, int band, double sun_elevation_rad)
      : transfer_(transfer),
        band_(band),
        towards_sun_(std::cos(sun_elevation_rad), 0.0, std::sin(sun_elevation_rad)),
        thickest_(transfer.medium().at(0.0).extinction[band]) {}

  /// From the ground towards `towards` (unit, z up, sun at azimuth 0 towards +x).
  Estimate radiance(const Eigen::Vector3d& towards, int paths) {
    return meanOf(paths, [&] { return path(towards); });
  }

 private:
  double sunlight(const Eigen::Vector3d& from_centre_km) const {
    const double r = from_centre_km.norm();
    return transfer_.transmittance(std::max(0.0, r - kEarthRadius_km),
                                   from_centre_km.dot(towards_sun_) / r)[band_];
  }

  /// Drawn by trial and error from a phase function that is largest straight ahead.
  template <typename Phase>
  double scatteringCosine(const Phase& phase) {
    for (;;) {
      // More trials near straight ahead, where aerosol scatters most: density ∝ 1 / (1.02 − cos)².
      const double cos_angle = 1.02 - 1.0 / (1.0 / 2.02 + uniform() * (1.0 / 0.02 - 1.0 / 2.02));
      const double proposal = 1.0 / ((1.02 - cos_angle) * (1.02 - cos_angle));
      const double ratio = phase(static_cast<float>(cos_angle)) / proposal;
      if (uniform() * kMostRatio < ratio) {
        return cos_angle;
      }
    }
  }

  double path(Eigen::Vector3d direction) {
    Eigen::Vector3d place(0.0, 0.0, kEarthRadius_km + 1e-6);
    double weight = 1.0;
    double sum = 0.0;
    for (int event = 0; event < 60; ++event) {
      const double r = place.norm();
      const Segment end = segment(std::max(0.0, r - kEarthRadius_km), place.dot(direction) / r);
      const double free_km = freePath(place, direction, end.length_km);
      place += direction * std::min(free_km, end.length_km);
      if (free_km >= end.length_km) {
        if (!end.hits_ground) {
          return sum;
        }
        weight *= transfer_.medium().parameters().ground_albedo;
        const Eigen::Vector3d up = place.normalized();
        place = up * (kEarthRadius_km + 1e-6);
        sum += weight / kPi * std::max(0.0, up.dot(towards_sun_)) * sunlight(place);
        direction = around(up, std::sqrt(uniform()));
        continue;
      }
      const LocalMedium local = transfer_.medium().at(place.norm() - kEarthRadius_km);
      const double rayleigh = local.rayleigh_scattering[band_];
      const double aerosol = local.aerosol_scattering[band_];
      weight *= (rayleigh + aerosol) / local.extinction[band_];
      const auto cos_sun = static_cast<float>(direction.dot(towards_sun_));
      const double phase =
          (rayleigh * rayleighPhase(cos_sun) + aerosol * aerosolPhase(cos_sun)) / (rayleigh + aerosol);
      sum += weight * phase * sunlight(place);
      const bool by_air = uniform() * (rayleigh + aerosol) < rayleigh;
      direction =
          around(direction, by_air ? scatteringCosine(rayleighPhase) : scatteringCosine(aerosolPhase));
    }
    return sum;
  }

  /// Woodcock tracking: free paths of the thickest air, of which thinner air lets a part pass.
  double freePath(const Eigen::Vector3d& place, const Eigen::Vector3d& direction, double limit_km) {
    double distance_km = 0.0;
    for (;;) {
      distance_km -= std::log(1.0 - uniform()) / thickest_;
      if (distance_km >= limit_km) {
        return distance_km;
      }
      const double altitude_km = (place + direction * distance_km).norm() - kEarthRadius_km;
      if (uniform() * thickest_ < transfer_.medium().at(altitude_km).extinction[band_]) {
        return distance_km;
      }
    }
  }

  /// No phase function here is ever more than this part of the proposal: Rayleigh's at −1, 0.119 · 2.02².
  static constexpr double kMostRatio = 0.49;

  const RadiativeTransfer& transfer_;
  int band_;
  Eigen::Vector3d towards_sun_;
  double thickest_;
};

}  // namespace sunlit::sky
