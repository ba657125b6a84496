/// Sunlight that arrives at each height without having been scattered.
#pragma once

#include <Eigen/StdVector>
#include <vector>

#include "medium.h"
#include "table_place.h"

namespace sunlit::sky {

/// What is left of the sun's irradiance at one place.
struct Beam {
  Spectrum scaled;   ///< in the scaled medium; zero where the sun is set
  float aerosol_km;  ///< on its way, in km of sea level aerosol
};

/// Tables by height and the sun's true angle above the refracted horizon of that height. Refraction lifts the
/// sun, so its light reaches into the shadow of a straight-rayed Earth, and spreads it, so that it is dimmer
/// there.
class Sunlight {
 public:
  explicit Sunlight(const Medium& medium);

  /// What all suns share at one height.
  struct Height {
    TablePlace row;
    double horizon;  ///< cosine of zenith of a sun half of which is seen
    double radius;   ///< of the disc there, as a difference of cosines of zenith
  };
  Height heightAt(double altitude_km) const;

  /// Towards the sun's disc, part of which may be below the horizon of that height. Without refraction.
  Beam at(const Height& height, double sun_cos_zenith) const;
  Beam at(double altitude_km, double sun_cos_zenith) const {
    return at(heightAt(altitude_km), sun_cos_zenith);
  }

 private:
  struct Row;
  Row makeRow(const Medium& medium, double altitude_km) const;

  using Spectra = std::vector<Spectrum, Eigen::aligned_allocator<Spectrum>>;
  Spectra depth_;                  // of the scaled medium; spreading counts as depth
  std::vector<float> aerosol_km_;  // likewise
  std::vector<float> lift_;  // by height: how far refraction lowers the horizon that light can cross, rad
};

}  // namespace sunlit::sky
