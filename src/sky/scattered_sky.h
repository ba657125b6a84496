/// What the air makes of the light of one distant disc.
#pragma once

#include <Eigen/Core>
#include <Eigen/StdVector>
#include <vector>

#include "radiative_transfer.h"
#include "sunlit/quantity/direction.h"

namespace sunlit::sky {

/// A disc as the air sees it.
struct AirLamp {
  Direction apparent;   ///< where its aureole is seen
  Direction geometric;  ///< from where it lights the air
  Spectrum strength;    ///< above the air, relative to the sun's irradiance at 1 AU
};

/// Luminance of the sky by one lamp. Rows by elevation, closer near the horizon:
/// elevation = 90° · (row / (kRows − 1))². Columns by azimuth from the lamp, 0 … 180°; the other half mirrors
/// it. Aerosol is kept without its phase function, so the aureole is as sharp as the function.
class ScatteredSky {
 public:
  ScatteredSky(const RadiativeTransfer& transfer, double altitude_km, const AirLamp& lamp);

  /// cd/m²; of the horizon below it. `towards` is a unit vector in `map`.
  Eigen::Array3f luminance(const Eigen::Vector3f& towards) const;

 private:
  static constexpr int kRows = 64;
  static constexpr int kColumns = 33;
  struct Node {
    Eigen::Array4f smooth;   // cd/m² in RGB; the fourth is padding
    Eigen::Array4f aerosol;  // cd/m² · sr
    Eigen::Array4f aerosol_again;
  };
  Eigen::Vector3f towards_;
  Eigen::Vector2f heading_;  // horizontal, unit
  std::vector<Node, Eigen::aligned_allocator<Node>> nodes_;
};

}  // namespace sunlit::sky
