/// The air between the camera and what one tile of the picture shows.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "sunlit/light/surfaces.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

/// Air varies slowly over the picture and with distance, and asking for it takes longer than all shading of a
/// surface. So it is asked for along the tile's corners, at distances a half-octave apart, and interpolated:
/// linearly, within 0.5 % of the light that it adds and takes.
class TileAir {
 public:
  /// Keeps references.
  TileAir(const Surfaces& surfaces, const sky::Daylight& day, const Tile& tile);

  /// For what `surface` of the tile shows.
  sky::AirColumn before(const Surface& surface);

 private:
  using Six = Eigen::Array<float, 6, 1>;  ///< transmittance and airlight
  using Corners = std::array<Six, 4>;     ///< top left, top right, bottom left, bottom right
  /// At distance node `k`, see nodeDistance_m().
  const Corners& node(int k);

  const Surfaces& surfaces_;
  const sky::Daylight& day_;
  const Tile& tile_;
  std::array<Eigen::Vector3f, 4> towards_;
  std::vector<Corners> nodes_;
  std::vector<bool> known_;
};

}  // namespace sunlit::light
