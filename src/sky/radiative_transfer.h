/// How sunlight spreads through the air: transmittance, and light scattered any number of times.
#pragma once

#include <vector>

#include "diffuse_light.h"
#include "sight_path.h"
#include "sunlight.h"

namespace sunlit::sky {

/// Where an eye above the ground looks, by the angles that a spherical Earth leaves.
struct LineOfSight {
  double altitude_km;     ///< of the eye, 0 … kAtmosphereHeight_km
  double cos_zenith;      ///< of the line of sight
  double sun_cos_zenith;  ///< of the sun's centre, at the eye
  double sun_cos_angle;   ///< between line of sight and sun
};

/// Radiance relative to the sun's irradiance, 1/sr, of scattered light, by how it was scattered.
struct Scattered {
  Spectrum smooth = Spectrum::Zero();   ///< by molecules, or at a large angle at least once, or by the ground
  Spectrum aerosol = Spectrum::Zero();  ///< once by aerosol; to be multiplied by aerosolPhase()
  /// Forwards by aerosol, again and again; to be multiplied by aerosolAgainPhase().
  Spectrum aerosol_again = Spectrum::Zero();

  Spectrum radiance(double sun_cos_angle) const {
    const auto cosine = static_cast<float>(sun_cos_angle);
    return smooth + aerosol * aerosolPhase(cosine) + aerosol_again * aerosolAgainPhase(cosine);
  }
};

/// Tables of one medium: light scattered once keeps its phase function, light scattered before is
/// DiffuseLight. Safe to read from many threads.
class RadiativeTransfer {
 public:
  explicit RadiativeTransfer(const MediumParameters& parameters, const TableStore& kept = {})
      : medium_(parameters), sunlight_(medium_), diffuse_(medium_, sunlight_, kept) {}

  const Medium& medium() const { return medium_; }
  const Sunlight& sunlight() const { return sunlight_; }
  const DiffuseLight& diffuse() const { return diffuse_; }
  /// Of the true medium along a ray from `altitude_km` to space, bent by refraction, which leaves the eye at
  /// the apparent `cos_zenith`; zero if it hits the ground.
  Spectrum transmittance(double altitude_km, double cos_zenith) const;
  /// A line of sight from `altitude_km` to its end, for scattered().
  SightPath sightFrom(double altitude_km, double cos_zenith) const;
  /// Light that reaches the eye along the line of sight.
  Scattered scattered(const SightPath& path, double sun_cos_zenith, double sun_cos_angle) const;
  Scattered scattered(const LineOfSight& sight) const {
    return scattered(sightFrom(sight.altitude_km, sight.cos_zenith), sight.sun_cos_zenith,
                     sight.sun_cos_angle);
  }
  /// What one step of a line of sight adds to scattered().
  void addStep(const SightStep& step, const SunAlong& sun, double sun_cos_angle, Scattered* sum) const;

 private:
  Medium medium_;
  Sunlight sunlight_;
  DiffuseLight diffuse_;
};

}  // namespace sunlit::sky
