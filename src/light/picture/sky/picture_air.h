/// The air between the camera and what the picture shows.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "light/picture/table/light_table.h"
#include "sunlit/light/surfaces.h"
#include "sunlit/sky/daylight.h"

namespace sunlit::light {

/// Air varies slowly over the picture and with distance, and asking for it takes longer than all shading of a
/// surface. So it is asked for along the tiles' corners, at distances a half-octave apart, and interpolated:
/// linearly, within 0.5 % of the light that it adds and takes. Where a way leaves or enters the fog on it, it
/// does not vary slowly, and is asked for each surface.
class PictureAir {
 public:
  /// Asks for all air that `table` needs, in parallel. Keeps references; `table` is of `surfaces`.
  /// `day` is seen from the eye.
  PictureAir(const Surfaces& surfaces, const LightTable& table, const sky::Daylight& day);

  /// Before surface `index` of Surfaces::tiles[tile].
  sky::AirColumn before(std::size_t tile, std::size_t index) const;

 private:
  using Six = Eigen::Array<float, 6, 1>;  ///< transmittance and airlight

  void find(int column, int row);
  /// Nodes that surfaces of the tiles about this corner need, one bit each.
  std::uint64_t needed(int column, int row) const;
  std::size_t place(int column, int row) const {
    return static_cast<std::size_t>((row * (columns_ + 1) + column) * kAirNodes);
  }

  const Surfaces& surfaces_;
  const LightTable& table_;
  const sky::Daylight& day_;
  float fog_top_m_;         ///< above the eye
  int columns_, rows_;      ///< of tiles
  std::vector<Six> nodes_;  ///< of each corner, by row and column; unset where nobody needs them
};

}  // namespace sunlit::light
