/// A line of sight through the air, prepared for light from any sun.
#pragma once

#include <Eigen/StdVector>
#include <vector>

#include "ray_path.h"
#include "sunlight.h"

namespace sunlit::sky {

/// A short piece of a line of sight.
struct SightStep {
  // Scattering coefficient × transmittance to the eye (of the scaled medium) × length:
  Spectrum by_air;      // of molecules
  Spectrum by_aerosol;  // of aerosol, all that it scatters
  RayPoint middle;
  float aerosol_km;  // from the eye to the middle, in km of sea level aerosol
  // Of the middle, what light from every sun asks for:
  double height_root;  // heightRoot()
  double z, level;     // of the direction: upwards there, and the rest
  Sunlight::Height sunlight;
};

struct SightPath {
  std::vector<SightStep, Eigen::aligned_allocator<SightStep>> steps;
  double cos_zenith = 0.0, sin_zenith = 1.0;  // at the eye
  bool hits_ground = false;
  Spectrum transmittance = Spectrum::Ones();  // of the scaled medium, to the end
  RayPoint end;
};

SightPath sightPath(const Medium& medium, const Sunlight& sunlight, const SightStart& start,
                    const std::vector<double>& edges_km);

/// The sun as seen along one line of sight: in the frame of that line's plane.
struct SunAlong {
  /// Cosines at the eye: of the sun's zenith angle, and of the angle between sun and line of sight.
  SunAlong(const SightPath& path, double sun_cos_zenith, double sun_cos_angle)
      : across(path.sin_zenith > 1e-6 ? (sun_cos_angle - path.cos_zenith * sun_cos_zenith) / path.sin_zenith
                                      : 0.0),
        up(sun_cos_zenith) {}
  double cosineTo(const Eigen::Vector2d& direction) const {
    return std::clamp(direction.x() * across + direction.y() * up, -1.0, 1.0);
  }
  double across, up;  // components of the direction towards the sun: along the sight's azimuth, and upwards
};

}  // namespace sunlit::sky
