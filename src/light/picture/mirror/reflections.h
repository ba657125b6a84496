/// What smooth surfaces of a picture mirror: the surroundings themselves, met by rays.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sunlit/light/surfaces.h"

namespace sunlit::light {

struct Reflections {
  /// One of a tile's surfaces.
  struct Mirroring {
    std::uint32_t surface;  ///< index into Tile::surfaces
    float by_rays;          ///< share of its mirrored light that rays tell, 0 … 1
    /// Those that its rays met, in the tile of `seen`: parts of all of its rays by Surface::samples, each
    /// coloured by Surface::share.
    std::uint32_t first = 0, count = 0;
    std::uint32_t rays = 0;
    Eigen::Array3f sky = Eigen::Array3f::Zero();  ///< share of the rays that met nothing, coloured by glass
    Eigen::Vector3f towards = Eigen::Vector3f::UnitZ();  ///< where these look, unit
  };
  /// In the order of their surfaces; one list a tile.
  std::vector<std::vector<Mirroring>> tiles;
  /// What the rays met, in the pixel of the surface that mirrors it, seen from there.
  Surfaces seen;
};

}  // namespace sunlit::light
