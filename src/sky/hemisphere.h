/// The sky above the horizon in pieces, to sum its light by.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sunlit/sky/daylight.h"

namespace sunlit::sky {

struct SkyPiece {
  Eigen::Vector3f towards;  ///< its middle in azimuth and in the sine of elevation
  float solid_angle;        ///< sr
};

/// 2,560 pieces, closer near the horizon, where a sky after sunset is brightest; small enough that an aureole
/// is no more than a piece or so too bright. The first edge lies at the horizontal unit vector `heading`.
std::vector<SkyPiece> hemisphere(const Eigen::Vector2f& heading);

/// Illuminance, lx, of level ground by a sky of the luminance, cd/m², that `luminance(towards)` says.
template <typename Luminance>
Eigen::Array3f levelIlluminance(const std::vector<SkyPiece>& pieces, const Luminance& luminance) {
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  for (const SkyPiece& piece : pieces)
    sum += luminance(piece.towards) * (piece.solid_angle * piece.towards.z());
  return sum;
}

/// The same by the direct light of a disc.
Eigen::Array3f onLevelGround(const DiscLight& disc);

}  // namespace sunlit::sky
