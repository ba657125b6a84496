/// How sunlight spreads through the air: transmittance, and light scattered any number of times.
#pragma once

#include <Eigen/StdVector>
#include <vector>

#include "medium.h"

namespace sunlit::sky {

/// A view from a height above the ground, in the plane geometry that a spherical Earth leaves:
struct View {
  double altitude_km;     ///< of the eye, 0 … kAtmosphereHeight_km
  double cos_zenith;      ///< of the line of sight
  double sun_cos_zenith;  ///< of the sun's centre, at the eye
  double sun_cos_angle;   ///< between line of sight and sun
};

/// Radiance relative to the sun's irradiance, 1/sr, of light that was scattered
struct Scattered {
  Spectrum smooth = Spectrum::Zero();   ///< by molecules, or at a large angle at least once, or by the ground
  Spectrum aerosol = Spectrum::Zero();  ///< once by aerosol; to be multiplied by aerosolPhase()
  Spectrum aerosol_again =
      Spectrum::Zero();  ///< forwards by aerosol, again and again; by aerosolAgainPhase()

  Spectrum radiance(double sun_cos_angle) const {
    const auto cosine = static_cast<float>(sun_cos_angle);
    return smooth + aerosol * aerosolPhase(cosine) + aerosol_again * aerosolAgainPhase(cosine);
  }
};

/// Tables of one medium. Light scattered twice or more is taken as scattered equally to all sides, so that it
/// depends on height and sun elevation only; scattered once it keeps its phase function (after Hillaire 2020,
/// but all orders are gathered over the real sphere, which twilight needs). Safe to read from many threads.
class Transport {
 public:
  explicit Transport(const MediumParameters& parameters);

  const Medium& medium() const { return medium_; }
  /// Of the true medium along a ray from `altitude_km` to space; zero if it hits the ground.
  Spectrum transmittance(double altitude_km, double cos_zenith) const;
  /// Of the scaled medium, towards the sun's disc, part of which may be below the horizon of that height.
  Spectrum scaledSunlight(double altitude_km, double sun_cos_zenith) const;
  /// Aerosol between `altitude_km` and the sun, in km of sea level aerosol.
  float aerosolTowardsSun(double altitude_km, double sun_cos_zenith) const;
  /// Mean over all directions of the diffuse radiance, 1/sr.
  Spectrum meanRadiance(double altitude_km, double sun_cos_zenith) const;
  /// Radiance of the ground, 1/sr.
  Spectrum groundRadiance(double sun_cos_zenith) const;
  /// Light that reaches the eye along the line of sight.
  Scattered scattered(const View& view) const;

 private:
  struct RayStep {
    Spectrum weight;             // scattering coefficient × transmittance to the eye × length of the step
    float eye_part, sight_part;  // sun_cos_zenith there = eye_part·(at the eye) + sight_part·(sun_cos_angle)
    float altitude_km;
    int altitude_index;
    float altitude_fraction;
  };
  struct Ray {
    float cos_zenith, solid_angle_weight;  // weights sum to 1 over the sphere
    std::vector<RayStep, Eigen::aligned_allocator<RayStep>> steps;
    Spectrum ground_transmittance;  // zero where the ray leaves to space
    float ground_eye_part, ground_sight_part;
  };
  struct Gathered {
    Spectrum mean = Spectrum::Zero();
    Spectrum down = Spectrum::Zero();  // irradiance of level ground, relative
  };
  using Spectra = std::vector<Spectrum, Eigen::aligned_allocator<Spectrum>>;

  void tabulateSunlight();
  std::vector<Ray> raysFrom(double altitude_km) const;
  Ray makeRay(double altitude_km, double cos_zenith, double weight) const;
  Gathered gatherOnce(const std::vector<Ray>& rays, double sun_cos_zenith) const;
  Gathered gatherAgain(const std::vector<Ray>& rays, double sun_cos_zenith) const;
  void scatterManyTimes();
  Spectrum interpolateMean(int altitude_index, float altitude_fraction, float sun_coordinate) const;

  Medium medium_;
  Spectra sunlight_;            // scaled transmittance by height and angle above that height's horizon
  std::vector<float> aerosol_;  // likewise: km of sea level aerosol
  Spectra mean_;                // by height and sun
  Spectra ground_;              // by sun
};

}  // namespace sunlit::sky
