/// What the air between an observer and space takes from light that comes from above.
#pragma once

#include <Eigen/StdVector>
#include <vector>

#include "radiative_transfer.h"
#include "sphere.h"

namespace sunlit::sky {

/// Transmittance by elevation, for one observer. Rows lie closer near the horizon:
/// elevation = 90° · (row / (kRows − 1))².
class Extinction {
 public:
  static constexpr int kRows = 49;
  Extinction(const RadiativeTransfer& transfer, double altitude_km);

  static float elevationOf(int row) {
    const float t = static_cast<float>(row) / (kRows - 1);
    return kHalfPi * t * t;
  }
  /// Row and fraction of an elevation in rad; below the horizon, that of the horizon.
  static float rowOf(float elevation) { return std::sqrt(std::max(0.0F, elevation) / kHalfPi) * (kRows - 1); }

  const Spectrum& transmittance(int row) const { return rows_[static_cast<std::size_t>(row)]; }
  /// Of light of the sun's colour.
  Eigen::Array3f colour(float elevation) const;

 private:
  std::vector<Spectrum, Eigen::aligned_allocator<Spectrum>> rows_;
  std::vector<Eigen::Array3f> colours_;
};

}  // namespace sunlit::sky
