/// The sky of one instant, tabulated.
#pragma once

#include <Eigen/Core>
#include <Eigen/StdVector>
#include <vector>

#include "sunlit/sky/daylight.h"
#include "transport.h"

namespace sunlit::sky {

/// Rows by elevation, closer near the horizon: elevation = 90° · (row / (kRows − 1))². Columns by azimuth
/// from the sun, 0 … 180°; the other half mirrors it. Aerosol is kept without its phase function, so the
/// aureole is as sharp as the function.
struct SkyTable {
  static constexpr int kRows = 64;
  static constexpr int kColumns = 33;
  static constexpr int kNormals = 21;  // a side of the octahedral map

  struct Node {
    Eigen::Array4f smooth;   // cd/m² in RGB; the fourth is padding
    Eigen::Array4f aerosol;  // cd/m² · sr
    Eigen::Array4f aerosol_again;
  };
  std::vector<Node, Eigen::aligned_allocator<Node>> sky;
  std::vector<Eigen::Array4f, Eigen::aligned_allocator<Eigen::Array4f>>
      illuminance;  // lx, by normal, in `map`
  Eigen::Vector3f towards_sun = Eigen::Vector3f::UnitZ();
  Eigen::Vector2f sun_heading = Eigen::Vector2f::UnitY();  // horizontal, unit
  DiscLight sun;
  DiscLight moon;
  std::vector<PointLight> stars;
  Eigen::Array3f ground_luminance = Eigen::Array3f::Zero();    // cd/m²
  Eigen::Array3f ground_illuminance = Eigen::Array3f::Zero();  // lx
  Eigen::Array3f haze_per_km = Eigen::Array3f::Zero();         // extinction near the ground

  Eigen::Array3f luminance(const Eigen::Vector3f& towards) const;
  Eigen::Array3f illuminanceOn(const Eigen::Vector3f& normal) const;
};

struct SkyScene {
  double altitude_km = 0.0;  ///< of the observer
  DiscLight sun;
  Direction geometric_sun;  ///< what lights the air
  double distance_au = 1.0;
};
SkyTable makeSkyTable(const Transport& transport, const SkyScene& scene);

}  // namespace sunlit::sky
