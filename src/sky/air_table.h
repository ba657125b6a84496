/// The air between the eye and surfaces up to the horizon and beyond: what it takes, and what it adds.
#pragma once

#include <Eigen/Core>
#include <Eigen/StdVector>
#include <vector>

#include "radiative_transfer.h"
#include "scattered_sky.h"

namespace sunlit::sky {

/// Lines of sight of one observer by elevation, down to the nadir, cut at distances which lie closer near the
/// eye. Below the observer's sea level the air goes on as at sea level, since the ground of a scene need not
/// be the model's.
class AirSights {
 public:
  static constexpr int kHalfRows = 16;
  static constexpr int kRows = 2 * kHalfRows + 1;
  static constexpr int kCuts = 28;

  AirSights(const RadiativeTransfer& transfer, double altitude_km);

  /// Where a direction and distance lie between rows (z = ±(row / kHalfRows − 1)²) and cuts
  /// (u = d / (d + 4 km); the last cut is the end of the air).
  struct Place {
    std::size_t first;  // node of the row and cut at or before
    float weights[4];   // of it, the next cut, and the same of the next row
  };
  static Place placeOf(float z, float distance_km);

  /// RGB transmittance of the real air.
  Eigen::Array4f transmittance(const Place& place) const;

 private:
  friend class LitAir;
  struct Sight {
    SightPath path;
    std::vector<std::size_t> steps_to_cut;  // number of steps from the eye to each cut
  };
  std::vector<Sight> sights_;
  std::vector<Eigen::Array4f, Eigen::aligned_allocator<Eigen::Array4f>> transmittance_;
};

/// The light of one lamp that the air scatters into those lines of sight, by azimuth from the lamp.
class LitAir {
 public:
  LitAir(const RadiativeTransfer& transfer, const AirSights& sights, const AirLamp& lamp);

  /// cd/m²
  Eigen::Array4f airlight(const Eigen::Vector3f& towards, const AirSights::Place& place) const;

 private:
  static constexpr int kColumns = 17;
  struct Node {
    Eigen::Array4f smooth;   // cd/m² in RGB; the fourth is padding
    Eigen::Array4f aerosol;  // cd/m² · sr
  };
  Eigen::Vector3f towards_;
  Eigen::Vector2f heading_;
  std::vector<Node, Eigen::aligned_allocator<Node>> nodes_;  // by column, row, cut
};

}  // namespace sunlit::sky
