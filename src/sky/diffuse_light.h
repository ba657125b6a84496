/// Light in the air that was scattered before, by height, sun and direction.
#pragma once

#include <Eigen/StdVector>
#include <array>
#include <vector>

#include "sight_path.h"
#include "sunlight.h"
#include "sunlit/sky/table_store.h"

namespace sunlit::sky {

/// Radiance over the sphere as means of itself times spherical harmonics up to the fourth degree, of a unit
/// direction with z up and x towards the sun's azimuth, by degree and then by order; those odd in y vanish.
constexpr int kDegrees = 5;
constexpr int kMoments = 15;
using Moments = std::array<Spectrum, kMoments>;

/// Higher orders of scattering in the scaled medium. The radiance around a point is kept by its moments, of
/// which molecules need the second degree and aerosol all; it is gathered over the real sphere, which
/// twilight needs, again and again until it no longer changes.
class DiffuseLight {
 public:
  /// Sine of the elevation of the lowest sun whose light reaches the air; lower, all is zero.
  static constexpr float kLowestSun = -0.375F;

  /// Takes seconds, unless they are among what is `kept`.
  DiffuseLight(const Medium& medium, const Sunlight& sunlight, const TableStore& kept);

  /// What one step of a line of sight scatters towards the eye of light scattered before; relative to the
  /// sun's irradiance, 1/sr.
  Spectrum towardsEye(const SightStep& step, const SunAlong& sun) const;
  /// Radiance of the ground, 1/sr.
  Spectrum ground(double sun_cos_zenith) const;

 private:
  struct Ray {
    SightPath path;
    float weight;  // solid angle; weights sum to 1 over the sphere
  };
  struct Gathered {
    Moments moments;
    Spectrum down = Spectrum::Zero();  // irradiance of level ground, relative
  };
  using Field = std::vector<Moments, Eigen::aligned_allocator<Moments>>;
  using Spectra = std::vector<Spectrum, Eigen::aligned_allocator<Spectrum>>;

  void compute(const Medium& medium, const Sunlight& sunlight);
  std::vector<float> numbers() const;
  bool take(const std::vector<float>& numbers);
  std::vector<Ray> raysFrom(const Medium& medium, const Sunlight& sunlight, double altitude_km) const;
  template <typename Radiance>
  Gathered gather(const std::vector<Ray>& rays, double sun_cos_zenith, const Radiance& radiance) const;
  void scatterOnce(const Medium& medium, const Sunlight& sunlight);
  Field gatherAt(int height, Spectra* ground) const;
  float addOrder(Spectra* gained, Spectra* rest);

  Field field_;     // by height and sun
  Spectra ground_;  // by sun
  // Empty once all is gathered:
  std::vector<std::vector<Ray>> rays_;  // by height
  Field once_;                          // as field_
  Spectra ground_once_;                 // as ground_
  float ground_scale_;
};

}  // namespace sunlit::sky
